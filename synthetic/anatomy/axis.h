// Centre lines and profiles of the swept organs.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace pelvireg::anatomy
{
/// A polyline whose corners are rounded by circular arcs: tangent-continuous, parametrised by arc length (mm).
/// Beyond its ends it goes on straight.
class Axis
{
public:
  /// `points` n >= 2 corners, mm; `fillet_radii` n - 2 radii of the inner corners, mm.
  /// Throws InputError (naming `owner`) when an arc does not fit between its neighbours.
  Axis(const std::string &owner, const std::vector<Eigen::Vector3d> &points, const std::vector<double> &fillet_radii);

  double length() const { return starts_.back(); }
  /// Arc length at which the last straight piece starts, mm.
  double last_straight_start() const { return starts_[starts_.size() - 2]; }
  Eigen::Vector3d point(double arc_length) const;
  Eigen::Vector3d tangent(double arc_length) const;

private:
  struct Piece
  {
    Eigen::Vector3d start, direction; ///< direction: unit tangent at the start
    Eigen::Vector3d inward;           ///< unit, towards the centre of the arc
    double curvature = 0;             ///< 1/mm; 0 for a straight piece
    double length = 0;
  };
  const Piece &piece_at(double arc_length, double &local) const;
  void append_line(const Eigen::Vector3d &start, const Eigen::Vector3d &end);

  std::vector<Piece> pieces_;
  std::vector<double> starts_; ///< arc length at the start of each piece, then the total
};

/// A value along an axis: monotone between stations (Fritsch and Carlson 1980), level at both ends, C1.
class Profile
{
public:
  /// `stations` ascending, same size as `values`, at least two.
  Profile(std::vector<double> stations, std::vector<double> values);

  double operator()(double station) const;

private:
  std::vector<double> stations_, values_, slopes_;
};

/// A closed smooth curve through n points at the parameters 0, 1, … n - 1 (period n): uniform Catmull-Rom, C1.
Eigen::Vector3d closed_curve(const std::vector<Eigen::Vector3d> &points, double parameter);
} // namespace pelvireg::anatomy
