#include "synthetic/anatomy/table_reader.h"

#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <cmath>

namespace pelvireg::anatomy
{
namespace
{
std::string type_name(const toml::node &value)
{
  switch (value.type())
  {
  case toml::node_type::string:
    return "a string";
  case toml::node_type::integer:
    return "an integer";
  case toml::node_type::floating_point:
    return "a number";
  case toml::node_type::boolean:
    return "a boolean";
  case toml::node_type::array:
    return "an array";
  case toml::node_type::table:
    return "a table";
  default:
    return "a date or time";
  }
}

std::string describe(Range range)
{
  if (std::abs(range.low) >= 1e6 && range.high >= 1e6)
    return "a finite number below 1e6 in size";
  if (range.high >= 1e6)
    return fmt::format("a number {} {}", range.low_open ? ">" : ">=", range.low);
  return fmt::format("a number {} {} and <= {}", range.low_open ? ">" : ">=", range.low, range.high);
}
} // namespace

TableReader::TableReader(const toml::table &table, std::string path, std::string file)
    : table_(&table), path_(std::move(path)), file_(std::move(file))
{
}

void TableReader::fail(const std::string &key, const std::string &problem) const
{
  throw InputError(fmt::format("Case '{}': {} {}", file_, full(key), problem));
}

const toml::node &TableReader::node(const std::string &key)
{
  known_.insert(key);
  const toml::node *value = table_->get(key);
  if (value == nullptr)
    fail(key, "is missing; add it (the built-in case t005 shows its unit and a usual value).");
  return *value;
}

double TableReader::checked(const toml::node &value, const std::string &key, Range range) const
{
  if (!value.is_number())
    fail(key, fmt::format("is {}, but {} is needed; write a plain number.", type_name(value), describe(range)));
  const double x = *value.value<double>();
  if (!(std::isfinite(x) && x >= range.low && x <= range.high && !(range.low_open && x <= range.low)))
    fail(key, fmt::format("is {}, but {} is needed; correct the value.", x, describe(range)));
  return x;
}

double TableReader::number(const std::string &key, Range range)
{
  return checked(node(key), key, range);
}

int TableReader::integer(const std::string &key, int low, int high)
{
  const toml::node &value = node(key);
  if (!value.is_integer() || *value.value<std::int64_t>() < low || *value.value<std::int64_t>() > high)
    fail(key, fmt::format("is {}, but an integer from {} to {} is needed; correct the value.",
                          value.is_number() ? fmt::format("{}", *value.value<double>()) : type_name(value), low, high));
  return static_cast<int>(*value.value<std::int64_t>());
}

std::string TableReader::text(const std::string &key)
{
  const toml::node &value = node(key);
  if (!value.is_string())
    fail(key, fmt::format("is {}, but a string is needed; put it in quotes.", type_name(value)));
  return *value.value<std::string>();
}

bool TableReader::flag(const std::string &key, bool otherwise)
{
  known_.insert(key);
  if (!table_->contains(key))
    return otherwise;
  const toml::node &value = node(key);
  if (!value.is_boolean())
    fail(key, fmt::format("is {}, but true or false is needed; write one without quotes.", type_name(value)));
  return *value.value<bool>();
}

std::vector<double> TableReader::numbers(const std::string &key, Range range, std::size_t least, std::size_t most)
{
  const toml::node &value = node(key);
  const toml::array *array = value.as_array();
  if (array == nullptr || array->size() < least || array->size() > most)
    fail(key, fmt::format("must be an array of {} numbers, but it is {}; correct the number of entries.",
                          least == most ? fmt::format("{}", least) : fmt::format("{} or more", least),
                          array == nullptr ? type_name(value) : fmt::format("an array of {}", array->size())));
  std::vector<double> result;
  for (std::size_t i = 0; i < array->size(); ++i)
    result.push_back(checked(*array->get(i), fmt::format("{}[{}]", key, i), range));
  return result;
}

std::vector<int> TableReader::integers(const std::string &key, int low, int high, std::size_t size)
{
  std::vector<int> result;
  for (const double x : numbers(key, {static_cast<double>(low), static_cast<double>(high), false}, size, size))
  {
    if (x != std::floor(x))
      fail(key, fmt::format("contains {}, but integers from {} to {} are needed; round it.", x, low, high));
    result.push_back(static_cast<int>(x));
  }
  return result;
}

Eigen::Vector3d TableReader::point(const std::string &key, Range range)
{
  const std::vector<double> values = numbers(key, range, 3, 3);
  return {values[0], values[1], values[2]};
}

std::vector<Eigen::Vector3d> TableReader::points(const std::string &key, std::size_t least)
{
  const toml::node &value = node(key);
  const toml::array *array = value.as_array();
  if (array == nullptr || array->size() < least)
    fail(key, fmt::format("must be an array of at least {} points [x, y, z], but it is {}; add points.", least,
                          array == nullptr ? type_name(value) : fmt::format("an array of {}", array->size())));
  std::vector<Eigen::Vector3d> result;
  for (std::size_t i = 0; i < array->size(); ++i)
  {
    const std::string name = fmt::format("{}[{}]", key, i);
    const toml::array *entry = array->get(i)->as_array();
    if (entry == nullptr || entry->size() != 3)
      fail(name, "is not a point; write three numbers [x, y, z] in mm.");
    result.push_back({checked(*entry->get(0), name, any_number), checked(*entry->get(1), name, any_number),
                      checked(*entry->get(2), name, any_number)});
  }
  return result;
}

std::vector<double> TableReader::stations(const std::string &key, std::size_t size, const std::string &values_key)
{
  const std::vector<double> values = numbers(key, {0, 1, false}, 2);
  if (values.size() != size)
    fail(key, fmt::format("has {} entries, but {} has {}; give one station a value.", values.size(), values_key, size));
  for (std::size_t i = 1; i < values.size(); ++i)
    if (!(values[i] > values[i - 1]))
      fail(key, fmt::format("is not ascending at entry {} ({} after {}); sort it.", i, values[i], values[i - 1]));
  return values;
}

TableReader TableReader::table(const std::string &key)
{
  const toml::node &value = node(key);
  if (!value.is_table())
    fail(key, fmt::format("is {}, but a table is needed; write [{}].", type_name(value), full(key)));
  return {*value.as_table(), full(key), file_};
}

std::vector<TableReader> TableReader::tables(const std::string &key)
{
  const toml::node &value = node(key);
  const toml::array *array = value.as_array();
  if (array == nullptr || array->empty() || !array->is_homogeneous(toml::node_type::table))
    fail(key, fmt::format("is {}, but an array of tables is needed; write [[{}]].", type_name(value), full(key)));
  std::vector<TableReader> result;
  for (std::size_t i = 0; i < array->size(); ++i)
    result.emplace_back(*array->get(i)->as_table(), fmt::format("{}[{}]", full(key), i), file_);
  return result;
}

std::vector<std::string> TableReader::keys() const
{
  std::vector<std::string> result;
  for (const auto &[key, value] : *table_)
    result.emplace_back(key.str());
  return result;
}

void TableReader::finish() const
{
  std::string allowed;
  for (const std::string &key : known_)
    allowed += (allowed.empty() ? "" : ", ") + key;
  for (const std::string &key : keys())
    if (known_.count(key) == 0)
      fail(key, fmt::format("is not a known key; allowed here: {}; remove it or correct its spelling.", allowed));
}
} // namespace pelvireg::anatomy
