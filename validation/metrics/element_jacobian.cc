#include "validation/metrics/element_jacobian.h"

#include "synthetic/dataset/error.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace pelvireg::metrics
{
namespace
{
/// A corner of an element and its three neighbours, in positive order.
using Corner = std::array<int, 4>;

constexpr std::array<Corner, 1> tet_corners = {{{0, 1, 2, 3}}};
constexpr std::array<Corner, 8> hex_corners = {
    {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7}, {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}}};

template <typename Element>
double determinant(const dataset::Points &points, const Element &element, const Corner &corner)
{
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k)
    edges.col(k) =
        (points.row(element[corner[static_cast<std::size_t>(k) + 1]]) - points.row(element[corner[0]])).transpose();
  return edges.determinant();
}

template <typename Elements, std::size_t n_corners>
void add(const dataset::Points &rest, const dataset::Points &deformed, const Elements &elements,
         const std::array<Corner, n_corners> &corners, ElementJacobian &result)
{
  for (Eigen::Index e = 0; e < elements.rows(); ++e)
  {
    const auto element = elements.row(e);
    double smallest = std::numeric_limits<double>::infinity();
    for (const Corner &corner : corners)
    {
      const double at_rest = determinant(rest, element, corner);
      if (!(at_rest > 0))
        throw InputError(fmt::format(
            "elements: element {} has determinant {} at rest, must be positive; check the mesh", e, at_rest));
      smallest = std::min(smallest, determinant(deformed, element, corner) / at_rest);
    }
    ++result.n_elements;
    result.n_inverted += !(smallest > 0);
    result.smallest = std::min(result.smallest, smallest);
  }
}

template <typename Elements> bool is_in_range(const Elements &elements, Eigen::Index n_points)
{
  return elements.size() == 0 || (elements.minCoeff() >= 0 && elements.maxCoeff() < n_points);
}
} // namespace

ElementJacobian element_jacobian(const dataset::Points &rest, const dataset::Points &deformed,
                                 const dataset::Tets &tets, const dataset::Hexes &hexes)
{
  if (rest.rows() != deformed.rows() || !rest.allFinite() || !deformed.allFinite())
    throw InputError(fmt::format("elements: got {} nodes at rest and {} deformed, must be as many and finite",
                                 rest.rows(), deformed.rows()));
  if (tets.rows() + hexes.rows() == 0 || !is_in_range(tets, rest.rows()) || !is_in_range(hexes, rest.rows()))
    throw InputError(fmt::format("elements: {} tetrahedra and {} hexahedra over {} nodes, there must be one and their "
                                 "nodes in range",
                                 tets.rows(), hexes.rows(), rest.rows()));
  ElementJacobian result;
  result.smallest = std::numeric_limits<double>::infinity();
  add(rest, deformed, tets, tet_corners, result);
  add(rest, deformed, hexes, hex_corners, result);
  return result;
}
} // namespace pelvireg::metrics
