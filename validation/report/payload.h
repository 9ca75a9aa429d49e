// What the page's script reads: a JSON head and named parts in one compressed text.
#pragma once

#include "synthetic/dataset/geometry.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pelvireg::report
{
/// Layout, before it is compressed (zlib) and written in base64, which holds no character that HTML could read:
/// length of the head (uint32), the head (JSON, UTF-8), the parts one after the other. Little-endian.
/// Head: {"parts": {name: [offset from the head's end, length]}, "model": what the caller gives}.
class Payload
{
public:
  /// A part under a name of its own.
  void add(const std::string &name, std::string bytes);

  /// Compressed text. The same content gives the same bytes.
  std::string encoded(const nlohmann::ordered_json &model) const;

private:
  std::vector<std::pair<std::string, std::string>> parts_;
};

/// Frames of n x 3 positions (mm, all of the same n) in int16 multiples of `quantum` mm: the first frame as it is, each
/// further one as difference from the frame before, modulo 2^16. Differences are folded (0, -1, 1, -2, … become 0, 1,
/// 2, 3, …) and all low bytes stand before all high bytes: frames that differ little compress well. Throws
/// std::runtime_error for a coordinate beyond what int16 can hold.
std::string pack_positions(const std::vector<dataset::Points> &frames, double quantum);

/// Frames of n values >= 0 (mm) in uint8 multiples of `quantum`, rounded; what is more than 255 of them is 255. As
/// above by differences, modulo 2^8.
std::string pack_values(const std::vector<std::vector<double>> &frames, double quantum);

/// Indices below 65536 as uint16, low bytes first as above, without differences. Throws std::runtime_error otherwise.
std::string pack_indices(const std::vector<std::int32_t> &indices);
} // namespace pelvireg::report
