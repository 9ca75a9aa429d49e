#include "validation/metrics/element_jacobian.h"

#include "synthetic/dataset/error.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

namespace pelvireg::metrics
{
namespace
{
/// A hexahedron of 2 x 3 x 4 mm in VTK order with two tetrahedra of its corners.
dataset::Points block()
{
  dataset::Points points(8, 3);
  points << 0, 0, 0, 2, 0, 0, 2, 3, 0, 0, 3, 0, 0, 0, 4, 2, 0, 4, 2, 3, 4, 0, 3, 4;
  return points;
}
dataset::Hexes one_hex()
{
  dataset::Hexes hexes(1, 8);
  hexes << 0, 1, 2, 3, 4, 5, 6, 7;
  return hexes;
}
dataset::Tets two_tets()
{
  dataset::Tets tets(2, 4);
  tets << 0, 1, 3, 4, 6, 5, 7, 2;
  return tets;
}

TEST(ElementJacobian, OfAnAffineMotionIsItsDeterminant)
{
  Eigen::Matrix3d gradient;
  gradient << 1.2, 0.3, -0.1, 0.2, 0.7, 0.4, -0.3, 0.1, 0.9;
  const dataset::Points deformed = (block() * gradient.transpose()).rowwise() + Eigen::RowVector3d(5, 6, 7);
  for (const auto &[tets, hexes] : {std::pair{two_tets(), dataset::Hexes(0, 8)}, {dataset::Tets(0, 4), one_hex()}})
  {
    const ElementJacobian found = element_jacobian(block(), deformed, tets, hexes);
    EXPECT_NEAR(found.smallest, gradient.determinant(), 1e-14);
    EXPECT_EQ(found.n_elements, tets.rows() + hexes.rows());
    EXPECT_EQ(found.n_inverted, 0);
  }
}

TEST(ElementJacobian, IsThatOfTheWorstElementAndOfTheWorstCorner)
{
  for (int node = 0; node < 8; ++node)
  {
    // One corner of the hexahedron on three quarters of its way along its edge in z: J there is 1/4; elsewhere more.
    dataset::Points deformed = block();
    deformed(node, 2) = node < 4 ? 3 : 1;
    EXPECT_NEAR(element_jacobian(block(), deformed, dataset::Tets(0, 4), one_hex()).smallest, 0.25, 1e-14) << node;
  }
  dataset::Points deformed = block();
  deformed(4, 2) = 1; // the first tetrahedron's tip
  EXPECT_NEAR(element_jacobian(block(), deformed, two_tets(), dataset::Hexes(0, 8)).smallest, 0.25, 1e-14);
}

TEST(ElementJacobian, CountsFlatAndInsideOutElementsAsInverted)
{
  for (const auto &[height, n_inverted] : {std::pair{1e-12, 0}, {0.0, 1}, {-1.0, 1}})
  {
    dataset::Points deformed = block();
    deformed(4, 2) = height;
    const ElementJacobian found = element_jacobian(block(), deformed, two_tets(), dataset::Hexes(0, 8));
    EXPECT_EQ(found.n_inverted, n_inverted) << height;
    EXPECT_NEAR(found.smallest, height / 4, 1e-15);
  }
}

TEST(ElementJacobian, RefusesWhatHasNoAnswer)
{
  EXPECT_THROW(element_jacobian(block(), block(), dataset::Tets(0, 4), dataset::Hexes(0, 8)), InputError);
  EXPECT_THROW(element_jacobian(block(), block().topRows(7), two_tets(), one_hex()), InputError);
  dataset::Points broken = block();
  broken(6, 1) = std::nan("");
  EXPECT_THROW(element_jacobian(block(), broken, two_tets(), one_hex()), InputError);
  EXPECT_THROW(element_jacobian(broken, block(), two_tets(), one_hex()), InputError);
  dataset::Tets out_of_range = two_tets();
  out_of_range(1, 2) = 8;
  EXPECT_THROW(element_jacobian(block(), block(), out_of_range, one_hex()), InputError);
  dataset::Tets inverted = two_tets();
  std::swap(inverted(0, 0), inverted(0, 1));
  EXPECT_THROW(element_jacobian(block(), block(), inverted, one_hex()), InputError) << "not positive at rest";
}
} // namespace
} // namespace pelvireg::metrics
