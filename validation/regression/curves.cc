#include "validation/regression/curves.h"

#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace pelvireg::regression
{
namespace
{
constexpr std::string_view step_header = "condition,sample,organ,step,n_points,mean_mm,sd_mm,p95_mm,max_mm";
constexpr std::string_view slice_header =
    "condition,sample,organ,slice_index,offset_mm,n_points,mean_mm,sd_mm,p95_mm,max_mm";

std::vector<std::string_view> split(std::string_view text, char separator)
{
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();)
  {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// One line of the file, which can say where it is wrong.
class Row
{
public:
  Row(const std::string &file, int line, std::string_view text, std::string_view header)
      : file_(file), line_(line), fields_(split(text, ',')), columns_(split(header, ','))
  {
    if (fields_.size() != columns_.size())
      throw InputError(fmt::format("{}, line {}: got {} fields, must be {} ({}); evaluate the result again", file, line,
                                   fields_.size(), columns_.size(), header));
  }

  std::string name(std::size_t column) const
  {
    if (fields_[column].empty())
      refuse(column, "must not be empty");
    return std::string(fields_[column]);
  }

  template <class Number> Number number(std::size_t column) const
  {
    const std::string_view field = fields_[column];
    Number value{};
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size())
      refuse(column, "must be a number");
    if constexpr (std::is_floating_point_v<Number>)
      if (!std::isfinite(value))
        refuse(column, "must be finite");
    return value;
  }

  double distance(std::size_t column) const
  {
    const double value = number<double>(column);
    if (!(value >= 0))
      refuse(column, "must not be negative");
    return value;
  }

  [[noreturn]] void refuse(std::size_t column, const std::string &allowed) const
  {
    throw InputError(fmt::format("{}, line {}: {} is '{}', {}; evaluate the result again", file_, line_,
                                 columns_[column], fields_[column], allowed));
  }

private:
  const std::string &file_;
  int line_;
  std::vector<std::string_view> fields_, columns_;
};

CurvePoint point_of(const Row &row, Axis axis)
{
  CurvePoint point;
  point.abscissa = row.number<int>(3);
  std::size_t column = 4;
  if (axis == Axis::slice)
    point.offset = row.number<double>(column++);
  point.n_points = row.number<int>(column);
  if (point.n_points < 1)
    row.refuse(column, "must be at least 1");
  point.mean = row.distance(column + 1);
  point.sd = row.distance(column + 2);
  point.p95 = row.distance(column + 3);
  point.max = row.distance(column + 4);
  const double round_off = 1e-8 * point.max; // nine digits are written
  if (!(point.mean <= point.max + round_off))
    row.refuse(column + 1, "must not be above max_mm");
  if (!(point.p95 <= point.max + round_off))
    row.refuse(column + 3, "must not be above max_mm");
  return point;
}

void require_every_step(const Curves &curves, const std::string &file)
{
  for (const auto &[name, family] : curves)
    for (const auto &[sample, curve] : family)
      for (std::size_t i = 0; i < curve.size(); ++i)
        if (curve[i].abscissa != static_cast<int>(i) + 1)
          throw InputError(fmt::format("{}: condition '{}', sample {}, {}: step {} is not there, steps must be "
                                       "1, 2, 3, ...; evaluate the result again",
                                       file, name.condition, sample, name.organ, i + 1));
}
} // namespace

std::string to_string(Axis axis)
{
  return axis == Axis::step ? "step" : "slice";
}

Curves read_curves(const std::string &text, Axis axis, const std::string &name)
{
  const std::string_view header = axis == Axis::step ? step_header : slice_header;
  std::vector<std::string_view> lines = split(text, '\n');
  if (lines.front() != header)
    throw InputError(fmt::format("{}: the first line is '{}', must be '{}'; evaluate the result with this version",
                                 name, lines.front().substr(0, 120), header));
  if (!lines.back().empty())
    throw InputError(fmt::format("{}: the last line is cut off; evaluate the result again", name));
  lines.pop_back();

  Curves curves;
  for (std::size_t i = 1; i < lines.size(); ++i)
  {
    const Row row(name, static_cast<int>(i) + 1, lines[i], header);
    Curve &curve = curves[{row.name(0), row.name(2), axis}][row.number<int>(1)];
    const CurvePoint point = point_of(row, axis);
    if (!curve.empty() && !(curve.back().abscissa < point.abscissa))
      row.refuse(3, "must be above that of the row before");
    curve.push_back(point);
  }
  if (curves.empty())
    throw InputError(fmt::format("{}: there is no row; evaluate the result again", name));
  if (axis == Axis::step)
    require_every_step(curves, name);
  return curves;
}
} // namespace pelvireg::regression
