#include "registration/implementation.h"

#include <algorithm>
#include <cmath>

namespace pelvireg::registration
{
void Registration::Implementation::add_row_forces(int first_row, int end_row)
{
  for (int row = first_row; row < end_row; ++row)
    for (const RowEntry *entry = rows.begin(row); entry != rows.end(row); ++entry)
      nodal_forces[entry->body].row(entry->node) += constraint_solver.multipliers()[row] * entry->jacobian.transpose();
}

void Registration::Implementation::measure_forces(const Observation &observation, StepSummary &summary)
{
  for (Points &forces : nodal_forces)
    forces.setZero();
  add_row_forces(0, summary.accepted_control_points); // the sliding rows come first
  for (const Points &forces : nodal_forces)
    for (Eigen::Index node = 0; node < forces.rows(); ++node)
    {
      const Eigen::Vector3d force = forces.row(node).transpose();
      const double across = force.dot(observation.plane_normal);
      summary.out_of_plane_force = std::max(summary.out_of_plane_force, std::abs(across));
      summary.in_plane_force = std::max(summary.in_plane_force, (force - across * observation.plane_normal).norm());
    }
  add_row_forces(summary.accepted_control_points, rows.size());
  for (const int body : active)
    for (Eigen::Index node = 0; node < nodal_forces[body].rows(); ++node)
      if (const int first = bodies[body].first_unknown(static_cast<int>(node)); first >= 0)
        summary.unbalanced_force =
            std::max(summary.unbalanced_force,
                     (bodies[body].load().segment<3>(first) + nodal_forces[body].row(node).transpose()).norm());
}

void Registration::Implementation::measure_residuals(const Observation &observation, StepSummary &summary)
{
  match_outlines(observation);
  int n_accepted = 0;
  double sum = 0;
  for (const Match &match : matches)
    if (match.sliding.is_accepted)
    {
      ++n_accepted;
      sum += std::abs(match.sliding.gap);
      summary.max_in_plane_residual = std::max(summary.max_in_plane_residual, std::abs(match.sliding.gap));
    }
  summary.mean_in_plane_residual = n_accepted > 0 ? sum / n_accepted : 0;
  for (const AttachedNode &node : attached_nodes)
    summary.attachment_residual =
        std::max(summary.attachment_residual,
                 attachment_gap(node, bodies[node.body_a].positions(), bodies[node.body_b].positions()).norm());
  for (const std::vector<HeldNode> &nodes : held_nodes)
    for (const HeldNode &node : nodes)
      summary.attachment_residual =
          std::max(summary.attachment_residual, held_gap(node, bodies[node.body].positions()).norm());
}

void Registration::Implementation::measure_contact(StepSummary &summary)
{
  for (const PairPenetration &pair : penetrations)
  {
    summary.penetration_depth = std::max(summary.penetration_depth, pair.depth);
    summary.penetration_volume += pair.volume;
    summary.n_open_rays += pair.n_open_rays;
  }
}
} // namespace pelvireg::registration
