#include "reference_fe/decks/deck_text.h"

#include <cctype>

namespace pelvireg::reference_fe
{
namespace
{
constexpr std::size_t longest_name = 60; // of 80 that both programs take: prefixes and suffixes are added
} // namespace

std::string deck_name(const std::string &name)
{
  std::string word;
  for (const char c : name.substr(0, longest_name))
    word += std::isalnum(static_cast<unsigned char>(c)) && static_cast<unsigned char>(c) < 128
                ? static_cast<char>(std::toupper(static_cast<unsigned char>(c)))
                : '_';
  return word.empty() || std::isalpha(static_cast<unsigned char>(word[0])) ? word : "N_" + word;
}

std::string printable(const std::string &text)
{
  std::string line = text.substr(0, longest_name);
  for (char &c : line)
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126)
      c = '_';
  return line;
}
} // namespace pelvireg::reference_fe
