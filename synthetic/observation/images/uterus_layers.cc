#include "synthetic/observation/images/uterus_layers.h"

#include <algorithm>
#include <cmath>

namespace pelvireg::observation
{
namespace
{
constexpr double lattice_step = 3;          ///< mm
constexpr double junctional_zone_at = 10.5; ///< mm under the surface
constexpr double endometrium_at = 13.5;     ///< mm under the surface

/// From 0 to 1 over a millimetre.
double beyond(double depth, double border)
{
  return std::clamp(depth - border + 0.5, 0.0, 1.0);
}
} // namespace

UterusLayers::UterusLayers(const dataset::Points &surface)
{
  origin_ = surface.colwise().minCoeff();
  const Eigen::Vector3d extent = surface.colwise().maxCoeff().transpose() - origin_;
  size_ = (extent / lattice_step).array().ceil().cast<int>() + 1;
  for (int k = 0; k < size_.z(); ++k)
    for (int j = 0; j < size_.y(); ++j)
      for (int i = 0; i < size_.x(); ++i)
      {
        const Eigen::RowVector3d point = (origin_ + lattice_step * Eigen::Vector3d(i, j, k)).transpose();
        depths_.push_back(std::sqrt((surface.rowwise() - point).rowwise().squaredNorm().minCoeff()));
      }
}

double UterusLayers::depth_at(const Eigen::Vector3d &material) const
{
  const Eigen::Vector3d place = (material - origin_) / lattice_step;
  Eigen::Vector3i cell;
  Eigen::Vector3d t;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double held = std::clamp(place[axis], 0.0, static_cast<double>(size_[axis] - 1));
    cell[axis] = std::clamp(static_cast<int>(held), 0, std::max(0, size_[axis] - 2));
    t[axis] = held - cell[axis];
  }
  double depth = 0;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i)
        depth +=
            (i ? t.x() : 1 - t.x()) * (j ? t.y() : 1 - t.y()) * (k ? t.z() : 1 - t.z()) *
            depths_[static_cast<std::size_t>(((cell.z() + k) * size_.y() + cell.y() + j) * size_.x() + cell.x() + i)];
  return depth;
}

double UterusLayers::signal(const Eigen::Vector3d &material, const TissueSignals &signals) const
{
  const double depth = depth_at(material);
  const double inner = beyond(depth, junctional_zone_at), cavity = beyond(depth, endometrium_at);
  return (1 - inner) * signals.myometrium + (inner - cavity) * signals.junctional_zone + cavity * signals.endometrium;
}
} // namespace pelvireg::observation
