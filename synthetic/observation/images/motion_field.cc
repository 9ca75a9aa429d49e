#include "synthetic/observation/images/motion_field.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pelvireg::observation
{
namespace
{
constexpr double softening = 1.5;    ///< mm, e of the header
constexpr double lattice_step = 8.0; ///< mm in the plane
} // namespace

Eigen::Vector3d extended_displacement(const MovedPoints &points, const Eigen::Vector3d &position, bool fades)
{
  const dataset::Points offsets = (points.rest + points.displacements).rowwise() - position.transpose();
  const Eigen::ArrayXd squared = offsets.rowwise().squaredNorm().array() + softening * softening;
  const Eigen::ArrayXd weights = points.areas.array() / squared.square();
  const double rest = fades ? std::numbers::pi / (motion_reach * motion_reach) : 0;
  return (points.displacements.transpose() * weights.matrix()) / (rest + weights.sum());
}

MotionField::MotionField(const dataset::ImageGeometry &geometry, double half_thickness, const MovedPoints &points,
                         bool fades)
{
  const Eigen::Vector3d normal = geometry.column_direction.cross(geometry.row_direction);
  axes_.row(0) = geometry.column_direction;
  axes_.row(1) = geometry.row_direction;
  axes_.row(2) = normal;
  origin_ = geometry.origin - half_thickness * normal;
  const auto n_steps = [](double length) { return std::max(1, static_cast<int>(std::ceil(length / lattice_step))); };
  const int n_columns = n_steps(geometry.spacing[0] * geometry.columns);
  const int n_rows = n_steps(geometry.spacing[1] * geometry.rows);
  size_ = {n_columns + 1, n_rows + 1, 3};
  step_ = {geometry.spacing[0] * geometry.columns / n_columns, geometry.spacing[1] * geometry.rows / n_rows,
           half_thickness};
  for (int k = 0; k < size_.z(); ++k)
    for (int j = 0; j < size_.y(); ++j)
      for (int i = 0; i < size_.x(); ++i)
        values_.push_back(extended_displacement(
            points, origin_ + axes_.transpose() * Eigen::Vector3d(i, j, k).cwiseProduct(step_), fades));
}

MotionField MotionField::between(const MotionField &a, const MotionField &b, double share)
{
  MotionField field = a;
  for (std::size_t i = 0; i < field.values_.size(); ++i)
    field.values_[i] += share * (b.values_[i] - a.values_[i]);
  return field;
}

std::size_t MotionField::node(int i, int j, int k) const
{
  return static_cast<std::size_t>((k * size_.y() + j) * size_.x() + i);
}

Eigen::Vector3d MotionField::displacement_at(const Eigen::Vector3d &position) const
{
  const Eigen::Vector3d place = (axes_ * (position - origin_)).cwiseQuotient(step_);
  Eigen::Vector3i cell;
  Eigen::Vector3d t;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double held = std::clamp(place[axis], 0.0, static_cast<double>(size_[axis] - 1));
    cell[axis] = std::min(static_cast<int>(held), size_[axis] - 2);
    t[axis] = held - cell[axis];
  }
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i)
        value += (i ? t.x() : 1 - t.x()) * (j ? t.y() : 1 - t.y()) * (k ? t.z() : 1 - t.z()) *
                 values_[node(cell.x() + i, cell.y() + j, cell.z() + k)];
  return value;
}
} // namespace pelvireg::observation
