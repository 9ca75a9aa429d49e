// The text at the head of an NRRD file.
#pragma once

#include <Eigen/Core>

#include <istream>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pelvireg::observation
{
/// One axis, the fastest first.
struct NrrdAxis
{
  std::size_t size = 0;
  std::optional<Eigen::Vector3d> step; ///< mm, LPS; none: not an axis of space
  std::string kind;                    ///< lower case; empty when not given
  std::optional<double> thickness;     ///< mm
};

struct NrrdHeader
{
  std::string type; ///< "float", "double", "int8" … "uint64"
  bool is_little_endian = true, is_gzip = false;
  std::vector<NrrdAxis> axes;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< centre of the first sample, mm, LPS
  std::string content;
  std::map<std::string, std::string> values; ///< key/value pairs
};

/// Reads up to and with the empty line that ends the header (format definition at teem.sourceforge.net/nrrd). `where`
/// names the file. Throws InputError for what is not NRRD, incomplete, or not supported: data in another file, another
/// encoding, a space other than LPS, RAS and LAS.
NrrdHeader read_nrrd_header(std::istream &in, const std::string &where);

/// A number written so that reading gives the same bits; the shortest such text.
std::string exact_text(double value);

/// Parses a whole word as a finite or not finite number; none when it is not a number.
std::optional<double> number_of(const std::string &word);
} // namespace pelvireg::observation
