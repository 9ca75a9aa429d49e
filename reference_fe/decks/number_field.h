// Numbers in the fields of other programs' files.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace pelvireg::reference_fe
{
inline std::string_view without_blanks(std::string_view text)
{
  const auto first = text.find_first_not_of(" \t");
  return first == text.npos ? std::string_view() : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

template <typename Number> std::optional<Number> whole_field(std::string_view text)
{
  text = without_blanks(text);
  if (text.starts_with('+') && !text.starts_with("+-"))
    text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size())
    return {};
  return value;
}

/// The integer that fills the field, blanks aside; none when it does not.
inline std::optional<int> integer_field(std::string_view text)
{
  return whole_field<int>(text);
}

/// The finite number that fills the field, blanks aside; none when it does not.
inline std::optional<double> number_field(std::string_view text)
{
  const std::optional<double> value = whole_field<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}
} // namespace pelvireg::reference_fe
