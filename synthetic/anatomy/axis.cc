#include "synthetic/anatomy/axis.h"

#include "synthetic/dataset/error.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pelvireg::anatomy
{
using Eigen::Vector3d;

Axis::Axis(const std::string &owner, const std::vector<Vector3d> &points, const std::vector<double> &fillet_radii)
{
  const auto n = points.size();
  Vector3d start = points.front();
  for (std::size_t i = 1; i + 1 < n; ++i)
  {
    const Vector3d in = (points[i] - points[i - 1]).normalized(), out = (points[i + 1] - points[i]).normalized();
    const double turn = std::atan2(in.cross(out).norm(), in.dot(out));
    const double setback = fillet_radii[i - 1] * std::tan(turn / 2);
    const Vector3d arc_start = points[i] - setback * in;
    if (!((arc_start - start).dot(in) >= 0) || !(setback <= (points[i + 1] - points[i]).norm()))
      throw InputError(
          fmt::format("{}: the arc of radius {} mm at corner {} of the axis needs {:.1f} mm on both sides, "
                      "more than its neighbours leave; lower the radius or move the corners apart.",
                      owner, fillet_radii[i - 1], i, setback));
    append_line(start, arc_start);
    if (turn > 1e-9)
    {
      const Vector3d inward = (out - in.dot(out) * in).normalized();
      pieces_.push_back({arc_start, in, inward, 1 / fillet_radii[i - 1], fillet_radii[i - 1] * turn});
    }
    start = points[i] + setback * out;
  }
  append_line(start, points.back());
  starts_.push_back(0);
  for (const Piece &piece : pieces_)
    starts_.push_back(starts_.back() + piece.length);
}

void Axis::append_line(const Vector3d &start, const Vector3d &end)
{
  const double length = (end - start).norm();
  if (length > 1e-12)
    pieces_.push_back({start, (end - start) / length, Vector3d::Zero(), 0, length});
}

const Axis::Piece &Axis::piece_at(double arc_length, double &local) const
{
  std::size_t i = 0;
  while (i + 1 < pieces_.size() && arc_length > starts_[i + 1])
    ++i;
  local = arc_length - starts_[i];
  return pieces_[i];
}

Vector3d Axis::point(double arc_length) const
{
  double s = 0;
  const Piece &piece = piece_at(arc_length, s);
  if (piece.curvature == 0)
    return piece.start + s * piece.direction;
  const double angle = s * piece.curvature;
  return piece.start + (std::sin(angle) * piece.direction + (1 - std::cos(angle)) * piece.inward) / piece.curvature;
}

Vector3d Axis::tangent(double arc_length) const
{
  double s = 0;
  const Piece &piece = piece_at(arc_length, s);
  const double angle = s * piece.curvature;
  return std::cos(angle) * piece.direction + std::sin(angle) * piece.inward;
}

Profile::Profile(std::vector<double> stations, std::vector<double> values)
    : stations_(std::move(stations)), values_(std::move(values)), slopes_(stations_.size(), 0.0)
{
  for (std::size_t i = 1; i + 1 < stations_.size(); ++i)
  {
    const double left = (values_[i] - values_[i - 1]) / (stations_[i] - stations_[i - 1]);
    const double right = (values_[i + 1] - values_[i]) / (stations_[i + 1] - stations_[i]);
    slopes_[i] = left * right > 0 ? 2 * left * right / (left + right) : 0;
  }
}

double Profile::operator()(double station) const
{
  if (station <= stations_.front())
    return values_.front();
  if (station >= stations_.back())
    return values_.back();
  const auto i =
      static_cast<std::size_t>(std::upper_bound(stations_.begin(), stations_.end(), station) - stations_.begin()) - 1;
  const double h = stations_[i + 1] - stations_[i], t = (station - stations_[i]) / h;
  return values_[i] * (1 + 2 * t) * (1 - t) * (1 - t) + slopes_[i] * h * t * (1 - t) * (1 - t) +
         values_[i + 1] * t * t * (3 - 2 * t) + slopes_[i + 1] * h * t * t * (t - 1);
}

Vector3d closed_curve(const std::vector<Vector3d> &points, double parameter)
{
  const int n = static_cast<int>(points.size());
  const int i = static_cast<int>(std::floor(parameter));
  const double t = parameter - i;
  const auto at = [&](int k) -> const Vector3d & { return points[static_cast<std::size_t>(((k % n) + n) % n)]; };
  const Vector3d slope_left = (at(i + 1) - at(i - 1)) / 2, slope_right = (at(i + 2) - at(i)) / 2;
  return at(i) * (1 + 2 * t) * (1 - t) * (1 - t) + slope_left * t * (1 - t) * (1 - t) +
         at(i + 1) * t * t * (3 - 2 * t) + slope_right * t * t * (t - 1);
}
} // namespace pelvireg::anatomy
