// Reference and registration hold the same pelvis: what each of them answers to the same force.
#include "reference_fe/pelvis_model.h"
#include "tests/unit/anatomy/cases.h"
#include "tests/verification/supports/registration_statics.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace pelvireg::test
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

INSTANTIATE_TEST_SUITE_P(Supports, EveryCase, testing::Values("t005", "quick"),
                         [](const auto &instance) { return instance.param; });

/// The part of the rectum that lies behind vagina and uterus, between the heights (mm) of the loaded nodes.
std::vector<int> loaded_nodes(const dataset::Points &points)
{
  std::vector<int> nodes;
  for (Eigen::Index n = 0; n < points.rows(); ++n)
    if (points(n, 2) > 40 && points(n, 2) < 90)
      nodes.push_back(static_cast<int>(n));
  return nodes;
}

/// As compliance_of_organ(), of the rectum in the reference at rest, no contact.
Matrix3d compliance_of_rectum_in_reference(dataset::Anatomy anatomy)
{
  anatomy.reference.contact_pairs.clear();
  reference_fe::PelvisModel model = reference_fe::build_pelvis_model(anatomy, 1);
  model.probe->prescribe_pressure(0);
  model.path->release();
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(model.system.n_unknowns());
  model.system.linearise_at(rest);
  model.system.assemble(rest, true);
  EXPECT_TRUE(model.system.factorise());

  int first = 0; // seven unknowns a shell node, shells first
  for (const dataset::ReferenceShell &shell : anatomy.reference.shells)
  {
    if (shell.name == "rectum")
      break;
    first += 7 * static_cast<int>(shell.midsurface.rows());
  }
  const std::vector<int> nodes = loaded_nodes(shell_of(anatomy, "rectum").midsurface);
  Matrix3d compliance;
  for (int axis = 0; axis < 3; ++axis)
  {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(rest.size());
    for (const int node : nodes)
      load[first + 7 * node + axis] = 1.0 / static_cast<double>(nodes.size());
    const Eigen::VectorXd motion = model.system.solve(load);
    for (int k = 0; k < 3; ++k)
    {
      double mean = 0;
      for (const int node : nodes)
        mean += motion[first + 7 * node + k] / static_cast<double>(nodes.size());
      compliance(k, axis) = mean;
    }
  }
  return compliance;
}

/// Mean distance of a band's two ends and the mean section of its bars: E A / L of the closed form, N/mm.
double closed_form_stiffness(const dataset::Anatomy &anatomy, const dataset::RegistrationAttachment &attachment)
{
  double area = 0, length = 0;
  int n_bars = 0;
  for (const dataset::ReferenceTruss &bar : anatomy.reference.trusses)
    if (bar.group == attachment.name)
      area += bar.area;
  const dataset::RegistrationBody &body = body_of(anatomy, attachment.body_a);
  for (const std::int32_t node : attachment.nodes_a)
  {
    // Grid lines run from an organ's end to a far end in consecutive nodes.
    std::int32_t far = node;
    while (std::find(body.fixed_nodes.begin(), body.fixed_nodes.end(), far) == body.fixed_nodes.end())
      ++far;
    length += (body.points.row(far) - body.points.row(node)).norm();
    ++n_bars;
  }
  return body.youngs_modulus * area / (length / n_bars);
}
} // namespace

TEST(Supports, HoldTheRectumAsFirmlyAsTheReferenceDoes)
{
  // Both models are one tube with the same ends, wall and fasciae; elements and supports differ by tens of per cent.
  // A rectum held by its fasciae alone is 14, 3 and 44 times as compliant as the reference along x, y, z.
  const dataset::Anatomy &anatomy = generated("quick");
  const std::vector<int> nodes = loaded_nodes(body_of(anatomy, "rectum").points);
  const Matrix3d ours = compliance_of_organ(anatomy.registration, "rectum", "fascia_sacrum", nodes);
  const Matrix3d reference = compliance_of_rectum_in_reference(anatomy);
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_GT(ours(axis, axis) / reference(axis, axis), 0.6) << "axis " << axis << ": " << ours(axis, axis) << " mm/N";
    EXPECT_LT(ours(axis, axis) / reference(axis, axis), 1.4) << "axis " << axis << ": " << ours(axis, axis) << " mm/N";
  }
}

TEST_P(EveryCase, HasBandsThatPullLikeBarsOfTheirSection)
{
  // Wide short bands are held across at both ends: up to 1 / (1 - nu^2) = 1.25 times as stiff as bars (plane strain).
  // A band of one cell along, all of whose nodes are held, would be 3.8 times as stiff at nu = 0.45.
  for (const dataset::RegistrationAttachment &attachment : anatomy().registration.attachments)
  {
    if (attachment.kind == "organ")
      continue;
    const Matrix3d stiffness = stiffness_of_band(anatomy().registration, attachment);
    EXPECT_LE((stiffness - stiffness.transpose()).norm(), 1e-4 * stiffness.norm()) << attachment.name;
    const double largest =
        Eigen::SelfAdjointEigenSolver<Matrix3d>(0.5 * (stiffness + stiffness.transpose())).eigenvalues()[2];
    const double bar = closed_form_stiffness(anatomy(), attachment);
    EXPECT_GT(largest / bar, 0.8) << attachment.name << ": " << largest << " N/mm";
    EXPECT_LT(largest / bar, 1.4) << attachment.name << ": " << largest << " N/mm";
  }
}
} // namespace pelvireg::test
