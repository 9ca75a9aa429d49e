#include "validation/report/payload.h"

#include "validation/report/base64.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace pelvireg::report
{
namespace
{
std::string compressed(const std::string &bytes)
{
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string result(size, '\0');
  const int status = compress2(reinterpret_cast<Bytef *>(result.data()), &size,
                               reinterpret_cast<const Bytef *>(bytes.data()), static_cast<uLong>(bytes.size()), 9);
  if (status != Z_OK)
    throw std::runtime_error(fmt::format("The report's data cannot be compressed (zlib status {})", status));
  result.resize(size);
  return result;
}

std::string in_planes(const std::vector<std::uint16_t> &words)
{
  std::string bytes(2 * words.size(), '\0');
  for (std::size_t i = 0; i < words.size(); ++i)
  {
    bytes[i] = static_cast<char>(words[i] & 0xff);
    bytes[words.size() + i] = static_cast<char>(words[i] >> 8);
  }
  return bytes;
}

/// 0, -1, 1, -2, … as 0, 1, 2, 3, …
template <typename Unsigned, typename Signed> Unsigned folded(Signed difference)
{
  return static_cast<Unsigned>(difference < 0 ? -2 * static_cast<int>(difference) - 1
                                              : 2 * static_cast<int>(difference));
}

std::int16_t quantised(double coordinate, double quantum)
{
  const double multiple = std::round(coordinate / quantum);
  if (!(std::abs(multiple) <= 32767))
    throw std::runtime_error(fmt::format("A position lies at {} mm: the report's 3-D view holds {:.0f} mm at most",
                                         coordinate, 32767 * quantum));
  return static_cast<std::int16_t>(multiple);
}
} // namespace

void Payload::add(const std::string &name, std::string bytes)
{
  parts_.emplace_back(name, std::move(bytes));
}

std::string Payload::encoded(const nlohmann::ordered_json &model) const
{
  nlohmann::ordered_json head = {{"parts", nlohmann::ordered_json::object()}, {"model", model}};
  std::string body;
  for (const auto &[name, bytes] : parts_)
  {
    head["parts"][name] = {body.size(), bytes.size()};
    body += bytes;
  }
  const std::string text = head.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string all;
  for (int shift = 0; shift < 32; shift += 8)
    all += static_cast<char>(text.size() >> shift & 0xff);
  return base64(compressed(all + text + body));
}

std::string pack_positions(const std::vector<dataset::Points> &frames, double quantum)
{
  std::vector<std::uint16_t> words;
  std::vector<std::int16_t> before;
  for (const dataset::Points &frame : frames)
  {
    before.resize(static_cast<std::size_t>(frame.size()), 0);
    for (Eigen::Index i = 0; i < frame.size(); ++i)
    {
      const std::int16_t now = quantised(frame.data()[i], quantum);
      std::int16_t &last = before[static_cast<std::size_t>(i)];
      words.push_back(folded<std::uint16_t>(static_cast<std::int16_t>(now - last)));
      last = now;
    }
  }
  return in_planes(words);
}

std::string pack_values(const std::vector<std::vector<double>> &frames, double quantum)
{
  std::string bytes;
  std::vector<std::uint8_t> before;
  for (const std::vector<double> &frame : frames)
  {
    before.resize(frame.size(), 0);
    for (std::size_t i = 0; i < frame.size(); ++i)
    {
      const auto now = static_cast<std::uint8_t>(std::clamp(std::round(frame[i] / quantum), 0.0, 255.0));
      bytes += static_cast<char>(folded<std::uint8_t>(static_cast<std::int8_t>(now - before[i])));
      before[i] = now;
    }
  }
  return bytes;
}

std::string pack_indices(const std::vector<std::int32_t> &indices)
{
  std::vector<std::uint16_t> words;
  for (const std::int32_t index : indices)
  {
    if (index < 0 || index > 65535)
      throw std::runtime_error(fmt::format("Node {} is beyond what the report's 3-D view can number", index));
    words.push_back(static_cast<std::uint16_t>(index));
  }
  return in_planes(words);
}
} // namespace pelvireg::report
