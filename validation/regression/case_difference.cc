#include "validation/regression/case_difference.h"

#include "synthetic/dataset/error.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <map>
#include <sstream>

namespace pelvireg::regression
{
namespace
{
using Entries = std::map<std::string, std::string>; ///< path to value as text

void collect(const toml::node &node, const std::string &path, Entries &entries)
{
  if (const toml::table *table = node.as_table())
  {
    entries[path] = "a table";
    for (const auto &[key, value] : *table)
      collect(value, path.empty() ? std::string(key.str()) : path + "." + std::string(key.str()), entries);
  }
  else if (const toml::array *array = node.as_array())
  {
    entries[path] = fmt::format("a list of {}", array->size());
    for (std::size_t i = 0; i < array->size(); ++i)
      collect((*array)[i], fmt::format("{}[{}]", path, i), entries);
  }
  else
  {
    // 1 and 1.0 are the same number; quotes keep the text "1" apart.
    std::ostringstream text;
    if (const auto number = node.value<double>(); number && node.is_number())
      text << fmt::format("{}", *number);
    else
      node.visit([&](const auto &value) { text << value; });
    entries[path] = text.str();
  }
}

Entries entries_of(const std::string &text, const std::string &which)
{
  try
  {
    Entries entries;
    toml::table table = toml::parse(text);
    table.erase("description");
    collect(table, "", entries);
    return entries;
  }
  catch (const toml::parse_error &error)
  {
    throw InputError(fmt::format("the case file of {} is not TOML: line {}: {}; make the result again", which,
                                 error.source().begin.line, error.description()));
  }
}
} // namespace

std::optional<std::string> case_difference(const std::string &baseline_text, const std::string &current_text)
{
  const Entries baseline = entries_of(baseline_text, "BASELINE"), current = entries_of(current_text, "CURRENT");
  for (const auto &[path, value] : baseline)
  {
    const auto other = current.find(path);
    if (other == current.end())
      return fmt::format("{} is not there, was {}", path, value);
    if (other->second != value)
      return fmt::format("{} is {}, was {}", path, other->second, value);
  }
  for (const auto &[path, value] : current)
    if (!baseline.contains(path))
      return fmt::format("{} is {}, was not there", path, value);
  return std::nullopt;
}
} // namespace pelvireg::regression
