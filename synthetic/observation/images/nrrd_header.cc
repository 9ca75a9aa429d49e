#include "synthetic/observation/images/nrrd_header.h"

#include "synthetic/dataset/error.h"

#include <utility>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>

namespace pelvireg::observation
{
namespace
{
using Fields = std::map<std::string, std::string>;

std::string lower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string trimmed(const std::string &text)
{
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> words_of(const std::string &text)
{
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;)
    words.push_back(word);
  return words;
}

/// "(1, 2,3) none (…)": a vector may have spaces inside.
std::vector<std::string> vectors_of(const std::string &text)
{
  std::vector<std::string> vectors;
  std::string current;
  bool is_inside = false;
  for (const char c : text + " ")
    if (c == '(' || is_inside)
    {
      is_inside = c != ')';
      if (c != ' ')
        current += c;
    }
    else if (c != ' ' && c != '\t')
      current += c;
    else if (!current.empty())
      vectors.push_back(std::exchange(current, {}));
  return vectors;
}

Eigen::Vector3d vector_of(const std::string &text, const std::string &field, const std::string &where)
{
  std::string inside = text.size() > 1 ? text.substr(1, text.size() - 2) : "";
  std::replace(inside.begin(), inside.end(), ',', ' ');
  const std::vector<std::string> words = words_of(inside);
  Eigen::Vector3d vector;
  bool is_good = words.size() == 3 && text.front() == '(' && text.back() == ')';
  for (std::size_t i = 0; i < 3 && is_good; ++i)
    if (const auto number = number_of(words[i]))
      vector[static_cast<Eigen::Index>(i)] = *number;
    else
      is_good = false;
  if (!is_good)
    throw InputError(fmt::format("{} has '{}' in its field '{}', but three numbers as (x,y,z) are needed; correct the "
                                 "header.",
                                 where, text, field));
  return vector;
}

/// Signs that turn coordinates of a space into LPS.
Eigen::Vector3d to_lps(const std::string &space, const std::string &where)
{
  const std::string name = lower(space);
  if (name == "left-posterior-superior" || name == "lps")
    return {1, 1, 1};
  if (name == "right-anterior-superior" || name == "ras")
    return {-1, -1, 1};
  if (name == "left-anterior-superior" || name == "las")
    return {1, -1, 1};
  throw InputError(fmt::format("{} has the space '{}', but left-posterior-superior, right-anterior-superior and "
                               "left-anterior-superior are understood; save it again with 3D Slicer.",
                               where, space));
}

/// The names that the format allows for one type.
std::string type_of(const std::string &name, const std::string &where)
{
  static const std::map<std::string, std::vector<std::string>> names = {
      {"int8", {"signed char", "int8", "int8_t"}},
      {"uint8", {"uchar", "unsigned char", "uint8", "uint8_t"}},
      {"int16", {"short", "short int", "signed short", "signed short int", "int16", "int16_t"}},
      {"uint16", {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}},
      {"int32", {"int", "signed int", "int32", "int32_t"}},
      {"uint32", {"uint", "unsigned int", "uint32", "uint32_t"}},
      {"float", {"float"}},
      {"double", {"double"}}};
  for (const auto &[type, aliases] : names)
    if (std::find(aliases.begin(), aliases.end(), lower(name)) != aliases.end())
      return type;
  throw InputError(fmt::format("{} holds pixels of type '{}', but 8 to 32 bit integers, float and double are "
                               "understood; save it with one of these.",
                               where, name));
}

const std::string &required(const Fields &fields, const std::string &name, const std::string &where)
{
  const auto field = fields.find(name);
  if (field == fields.end())
    throw InputError(
        fmt::format("{} has no field '{}' in its NRRD header; save it again with 3D Slicer.", where, name));
  return field->second;
}

void read_lines(std::istream &in, Fields &fields, std::map<std::string, std::string> &values, const std::string &where)
{
  std::string line;
  if (!std::getline(in, line) || line.rfind("NRRD000", 0) != 0)
    throw InputError(where + " is not an NRRD file: it does not begin with 'NRRD000'; give an .nrrd file or a folder "
                             "with a DICOM series.");
  constexpr std::size_t most_lines = 10000;
  for (std::size_t n = 0; n < most_lines && std::getline(in, line); ++n)
  {
    if (!line.empty() && line.back() == '\r')
      line.pop_back();
    if (line.empty())
      return;
    if (line[0] == '#')
      continue;
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos)
      throw InputError(fmt::format("{} has the line '{}' in its NRRD header, which is neither a field nor a key/value "
                                   "pair; correct the header.",
                                   where, line.substr(0, 60)));
    if (colon + 1 < line.size() && line[colon + 1] == '=')
      values[line.substr(0, colon)] = line.substr(colon + 2);
    else
      fields[lower(line.substr(0, colon))] = trimmed(line.substr(colon + 1));
  }
  throw InputError(where + " ends within its NRRD header; copy it again.");
}

void read_encoding(NrrdHeader &header, const Fields &fields, const std::string &where)
{
  const std::string encoding = lower(required(fields, "encoding", where));
  header.is_gzip = encoding == "gzip" || encoding == "gz";
  if (!header.is_gzip && encoding != "raw")
    throw InputError(fmt::format("{} has the encoding '{}', but raw and gzip are understood; save it with one of them.",
                                 where, encoding));
  for (const char *field : {"data file", "datafile", "line skip", "lineskip", "byte skip", "byteskip"})
    if (const auto found = fields.find(field); found != fields.end() && found->second != "0")
      throw InputError(fmt::format("{} says '{}: {}', but only data that follow the header are understood; save it as "
                                   "one .nrrd file.",
                                   where, field, found->second));
  header.type = type_of(required(fields, "type", where), where);
  if (header.type != "int8" && header.type != "uint8")
  {
    const std::string endian = lower(required(fields, "endian", where));
    if (endian != "little" && endian != "big")
      throw InputError(
          fmt::format("{} has the byte order '{}', but it must be little or big; correct the header.", where, endian));
    header.is_little_endian = endian == "little";
  }
}

void read_axes(NrrdHeader &header, const Fields &fields, const std::string &where)
{
  const std::vector<std::string> sizes = words_of(required(fields, "sizes", where));
  const auto dimension = number_of(required(fields, "dimension", where));
  if (!dimension || *dimension != static_cast<double>(sizes.size()) || sizes.size() < 2 || sizes.size() > 5)
    throw InputError(fmt::format("{} has dimension {} and sizes '{}', but they must agree and be 2 to 5; correct the "
                                 "header.",
                                 where, fields.at("dimension"), fields.at("sizes")));
  const Eigen::Vector3d signs = to_lps(required(fields, "space", where), where);
  const std::vector<std::string> steps = vectors_of(required(fields, "space directions", where));
  const auto kinds_field = fields.find("kinds"), thickness_field = fields.find("thicknesses");
  const auto kinds = kinds_field == fields.end() ? std::vector<std::string>{} : words_of(lower(kinds_field->second));
  const auto thicknesses =
      thickness_field == fields.end() ? std::vector<std::string>{} : words_of(thickness_field->second);
  if (steps.size() != sizes.size() || (!kinds.empty() && kinds.size() != sizes.size()) ||
      (!thicknesses.empty() && thicknesses.size() != sizes.size()))
    throw InputError(
        fmt::format("{} has {} sizes but {} space directions, {} kinds and {} thicknesses; each axis needs "
                    "its own, correct the header.",
                    where, sizes.size(), steps.size(), kinds.size(), thicknesses.size()));
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    const auto size = number_of(sizes[i]);
    if (!size || !(*size >= 1 && *size <= 1e6) || *size != std::floor(*size))
      throw InputError(
          fmt::format("{} has the size '{}', but 1 to 1000000 is allowed; correct the header.", where, sizes[i]));
    NrrdAxis axis{
        .size = static_cast<std::size_t>(*size), .step = {}, .kind = kinds.empty() ? "" : kinds[i], .thickness = {}};
    if (lower(steps[i]) != "none")
      axis.step = vector_of(steps[i], "space directions", where).cwiseProduct(signs);
    if (!thicknesses.empty())
      axis.thickness = number_of(thicknesses[i]);
    header.axes.push_back(axis);
  }
  header.origin =
      vector_of(trimmed(required(fields, "space origin", where)), "space origin", where).cwiseProduct(signs);
}
} // namespace

std::optional<double> number_of(const std::string &word)
{
  double value = 0;
  const char *end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (word.empty() || error != std::errc() || stop != end)
    return {};
  return value;
}

std::string exact_text(double value)
{
  return fmt::format("{}", value);
}

NrrdHeader read_nrrd_header(std::istream &in, const std::string &where)
{
  Fields fields;
  NrrdHeader header;
  read_lines(in, fields, header.values, where);
  read_encoding(header, fields, where);
  read_axes(header, fields, where);
  if (const auto content = fields.find("content"); content != fields.end())
    header.content = content->second;
  return header;
}
} // namespace pelvireg::observation
