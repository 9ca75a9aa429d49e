// The lines of a deck.
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace pelvireg::reference_fe
{
/// A name that both programs take: upper-case letters, digits and underscores, a letter first, at most 62.
std::string deck_name(const std::string &name);
/// One line of printable ASCII, at most 60 characters: for headings and comments.
std::string printable(const std::string &text);

/// What is written so far, and how lines of many numbers are broken.
class DeckText
{
public:
  template <typename... Arguments> void line(fmt::format_string<Arguments...> format, Arguments &&...arguments)
  {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    text_ += '\n';
  }

  /// Comma-separated, at most `per_line` a line, a comma at the end of a line that goes on.
  void list(const std::vector<std::string> &words, std::size_t per_line)
  {
    for (std::size_t i = 0; i < words.size(); ++i)
    {
      text_ += words[i];
      if (i + 1 < words.size())
        text_ += ',';
      if (i + 1 == words.size() || (i + 1) % per_line == 0)
        text_ += '\n';
    }
  }

  /// sum of weight * displacement = 0 in each direction; the first node is eliminated.
  void equations(const std::vector<int> &nodes, const std::vector<double> &weights)
  {
    for (int direction = 1; direction <= 3; ++direction)
    {
      line("*EQUATION\n{}", nodes.size());
      std::vector<std::string> terms;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        terms.push_back(fmt::format("{},{},{:.9g}", nodes[i], direction, weights[i]));
      list(terms, 4);
    }
  }

  std::string take() { return std::move(text_); }

private:
  std::string text_;
};
} // namespace pelvireg::reference_fe
