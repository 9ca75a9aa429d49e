#include "registration/constraints/contact_rows.h"

#include <algorithm>
#include <cmath>

namespace pelvireg::registration
{
std::array<Eigen::Vector3d, 2> tangents(const Eigen::Vector3d &normal)
{
  // Duff et al., "Building an orthonormal basis, revisited" (JCGT 6, 2017).
  const double sign = std::copysign(1.0, normal.z());
  const double a = -1 / (sign + normal.z()), b = normal.x() * normal.y() * a;
  return {Eigen::Vector3d(1 + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x()),
          Eigen::Vector3d(b, sign + normal.y() * normal.y() * a, -normal.y())};
}

void add_normal_row(const Contact &contact, const std::vector<ContactShare> &shares,
                    const std::array<ContactBody, 2> &bodies, double max_recovery, double compliance,
                    ConstraintRows &rows)
{
  rows.add_row(RowKind::contact, std::min(contact.depth, max_recovery), compliance);
  for (int s = contact.first_share; s < contact.end_share; ++s)
    rows.add_entry({bodies[shares[s].side].body, shares[s].node, shares[s].normal_jacobian});
}

void add_friction_rows(const Contact &contact, const std::vector<ContactShare> &shares,
                       const std::array<ContactBody, 2> &bodies, double compliance, ConstraintRows &rows)
{
  const auto signed_weight = [](const ContactShare &share) { return share.side == 0 ? share.weight : -share.weight; };
  Eigen::Vector3d slip = Eigen::Vector3d::Zero();
  for (int s = contact.first_share; s < contact.end_share; ++s)
  {
    const ContactBody &body = bodies[shares[s].side];
    slip += signed_weight(shares[s]) *
            (body.positions->row(shares[s].node) - body.slip_origins->row(shares[s].node)).transpose();
  }
  for (const Eigen::Vector3d &tangent : tangents(contact.normal))
  {
    rows.add_row(RowKind::friction, -tangent.dot(slip), compliance);
    for (int s = contact.first_share; s < contact.end_share; ++s)
      rows.add_entry({bodies[shares[s].side].body, shares[s].node, signed_weight(shares[s]) * tangent});
  }
}
} // namespace pelvireg::registration
