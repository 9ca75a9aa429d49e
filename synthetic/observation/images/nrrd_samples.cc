#include "synthetic/observation/images/nrrd_samples.h"

#include "synthetic/dataset/error.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace pelvireg::observation
{
namespace
{
static_assert(std::endian::native == std::endian::little, "bytes are turned round for files of the other order");
constexpr std::size_t most_bytes = std::size_t{4} << 30;

std::size_t size_of_type(const std::string &type)
{
  if (type == "double")
    return 8;
  if (type == "float" || type.ends_with("32"))
    return 4;
  return type.ends_with("16") ? 2 : 1;
}

std::size_t n_samples(const NrrdHeader &header, const std::string &where)
{
  double product = 1; // no overflow
  for (const NrrdAxis &axis : header.axes)
    product *= static_cast<double>(axis.size);
  if (!(product * static_cast<double>(size_of_type(header.type)) <= static_cast<double>(most_bytes)))
    throw InputError(fmt::format("{} says that it holds {} samples, but 4 GiB are the most; give a smaller part of it.",
                                 where, product));
  return static_cast<std::size_t>(product);
}

/// At most `n` bytes of a gzip stream, and whether it ends there.
std::string inflated(std::istream &in, std::size_t n, const std::string &where)
{
  const std::string packed{std::istreambuf_iterator<char>(in), {}};
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 32) != Z_OK) // 32: gzip or zlib header
    throw std::runtime_error("cannot start zlib");
  stream.next_in = reinterpret_cast<Bytef *>(const_cast<char *>(packed.data()));
  stream.avail_in = static_cast<uInt>(std::min<std::size_t>(packed.size(), UINT32_MAX));
  std::string bytes;
  std::array<char, 1 << 16> buffer{};
  int status = Z_OK;
  while (status == Z_OK && bytes.size() <= n)
  {
    stream.next_out = reinterpret_cast<Bytef *>(buffer.data());
    stream.avail_out = static_cast<uInt>(buffer.size());
    status = inflate(&stream, Z_NO_FLUSH);
    bytes.append(buffer.data(), buffer.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (status != Z_OK && status != Z_STREAM_END)
    throw InputError(where + " has damaged gzip data, or they end too soon; copy it again.");
  return bytes;
}

std::string all_bytes(std::istream &in, std::size_t n)
{
  std::string bytes;
  std::array<char, 1 << 16> buffer{};
  while (bytes.size() <= n && in.read(buffer.data(), buffer.size()).gcount() > 0)
    bytes.append(buffer.data(), static_cast<std::size_t>(in.gcount()));
  return bytes;
}

template <typename Sample> std::vector<float> converted(std::string &bytes, std::size_t n, bool is_little_endian)
{
  std::vector<float> samples(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    char *first = bytes.data() + i * sizeof(Sample);
    if (!is_little_endian)
      std::reverse(first, first + sizeof(Sample));
    Sample sample;
    std::memcpy(&sample, first, sizeof(Sample));
    samples[i] = static_cast<float>(sample);
  }
  return samples;
}
} // namespace

std::vector<float> read_nrrd_samples(std::istream &in, const NrrdHeader &header, const std::string &where)
{
  const std::size_t n = n_samples(header, where), n_bytes = n * size_of_type(header.type);
  std::string bytes = header.is_gzip ? inflated(in, n_bytes, where) : all_bytes(in, n_bytes);
  if (bytes.size() != n_bytes)
    throw InputError(fmt::format("{} holds {} bytes of pixels, but its sizes need {}; copy it again.", where,
                                 bytes.size() < n_bytes ? std::to_string(bytes.size()) : "too many", n_bytes));
  const bool little = header.is_little_endian;
  if (header.type == "int8")
    return converted<std::int8_t>(bytes, n, little);
  if (header.type == "uint8")
    return converted<std::uint8_t>(bytes, n, little);
  if (header.type == "int16")
    return converted<std::int16_t>(bytes, n, little);
  if (header.type == "uint16")
    return converted<std::uint16_t>(bytes, n, little);
  if (header.type == "int32")
    return converted<std::int32_t>(bytes, n, little);
  if (header.type == "uint32")
    return converted<std::uint32_t>(bytes, n, little);
  if (header.type == "double")
    return converted<double>(bytes, n, little);
  return converted<float>(bytes, n, little);
}
} // namespace pelvireg::observation
