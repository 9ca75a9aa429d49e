#include "synthetic/anatomy/built_in_cases.h"
#include "synthetic/anatomy/case.h"
#include "synthetic/dataset/error.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <optional>
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

void merge(toml::table &base, const toml::table &changes);

/// Tables with a name change the table of the same name, or follow at the end.
void merge_named(toml::array &base, const toml::array &changes)
{
  for (const toml::node &change : changes)
  {
    const auto name = change.as_table()->get_as<std::string>("name");
    const auto same = std::find_if(base.begin(), base.end(),
                                   [&](const toml::node &entry)
                                   { return name && entry.is_table() && entry.as_table()->at_path("name") == *name; });
    if (same == base.end())
      base.push_back(*change.as_table());
    else
      merge(*same->as_table(), *change.as_table());
  }
}

void merge(toml::table &base, const toml::table &changes)
{
  for (const auto &[key, value] : changes)
  {
    toml::node *present = base.get(key);
    if (present && present->is_table() && value.is_table())
      merge(*present->as_table(), *value.as_table());
    else if (present && present->is_array_of_tables() && value.is_array_of_tables())
      merge_named(*present->as_array(), *value.as_array());
    else
      base.insert_or_assign(key, value);
  }
}
} // namespace

std::string with_base(const std::string &text, const std::string &case_name)
{
  const toml::table changes = parsed(text, description_of(case_name));
  if (!changes.contains("base"))
    return text;
  const auto base_name = changes["base"].value<std::string>();
  std::string names;
  for (const BuiltInCase &built_in : built_in_case_texts())
  {
    if (base_name == built_in.name && base_name != case_name)
    {
      toml::table document = parsed(with_base(built_in.text, built_in.name), description_of(built_in.name));
      merge(document, changes);
      document.erase("base");
      return written(document);
    }
    names += (names.empty() ? "" : ", ") + std::string(built_in.name);
  }
  throw InputError(fmt::format("{}: base is {}, but the name of another built-in case is needed ({}); correct it or "
                               "write the whole case without base.",
                               description_of(case_name), base_name ? "'" + *base_name + "'" : "not a string", names));
}

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

std::optional<std::string> self_generated_from(const std::string &text, const std::string &case_name)
{
  return parsed(text, description_of(case_name))["self_generated_from"].value<std::string>();
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
