#include "synthetic/anatomy/case.h"
#include "synthetic/dataset/error.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <sstream>

namespace pelvireg::anatomy
{
namespace
{
toml::table parsed(const std::string &text, const std::string &what)
{
  try
  {
    return toml::parse(text);
  }
  catch (const toml::parse_error &error)
  {
    throw InputError(fmt::format("{} is not valid TOML at line {}: {}; correct that line.", what,
                                 error.source().begin.line, error.description()));
  }
}

std::string written(const toml::table &table)
{
  std::ostringstream text;
  text << toml::toml_formatter(table) << '\n';
  return text.str();
}

std::string description_of(const std::string &case_name)
{
  return "Case '" + case_name + "'";
}
} // namespace

std::string with_value(const std::string &text, const std::string &case_name, const std::string &key,
                       const std::string &value)
{
  toml::table document = parsed(text, description_of(case_name));
  const toml::table replacement = parsed("value = " + value, "The value of " + key);
  toml::table *place = &document;
  std::string rest = key;
  for (std::size_t dot = rest.find('.'); dot != std::string::npos; dot = rest.find('.'))
  {
    const std::string name = rest.substr(0, dot);
    rest = rest.substr(dot + 1);
    if (!place->contains(name))
      place->insert(name, toml::table{});
    place = place->get(name)->as_table();
    if (place == nullptr)
      throw InputError(fmt::format("{}: '{}' is not a table, so it has no {}; give another key.",
                                   description_of(case_name), name, rest));
  }
  place->insert_or_assign(rest, *replacement.get("value"));
  return written(document);
}

std::string reference_text(const std::string &text, const std::string &case_name)
{
  toml::table document = parsed(text, description_of(case_name));
  for (const char *key : {"name", "description", "registration"})
    document.erase(key);
  if (toml::table *plane = document["plane"].as_table())
    for (const char *key : {"slice_pitch", "n_slices_each_side"})
      plane->erase(key);
  if (toml::array *supports = document["support"].as_array())
    for (toml::node &support : *supports)
      if (toml::table *table = support.as_table())
        for (const char *key : {"body", "kind", "band_cells"})
          table->erase(key);
  return written(document);
}

double number_in_case(const std::string &text, const std::string &case_name, const std::string &key)
{
  const toml::table document = parsed(text, description_of(case_name));
  const auto value = document.at_path(key).value<double>();
  if (!value)
    throw InputError(fmt::format("{}: {} is not a number that can be read; add it.", description_of(case_name), key));
  return *value;
}
} // namespace pelvireg::anatomy
