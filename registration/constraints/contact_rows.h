// Constraint rows of a contact, along the touching surfaces' normal and, with friction, along the surfaces.
#pragma once

#include "registration/constraints/constraint_rows.h"
#include "registration/constraints/volume_contact.h"

#include <array>
#include <vector>

namespace pelvireg::registration
{
/// A body of a contact: its index, where its nodes are, and where they were when slip was zero. All mm.
struct ContactBody
{
  int body = 0;
  const Points *positions = nullptr;
  const Points *slip_origins = nullptr;
};

/// The row along the touching surfaces' normal, which must close at least min(depth, max_recovery).
void add_normal_row(const Contact &contact, const std::vector<ContactShare> &shares,
                    const std::array<ContactBody, 2> &bodies, double max_recovery, double compliance,
                    ConstraintRows &rows);

/// Two rows along the surfaces: the mean motion of side a less that of side b since the slip's origin. What is left in
/// them is slip; zero slip brings the surfaces back to where they stuck.
void add_friction_rows(const Contact &contact, const std::vector<ContactShare> &shares,
                       const std::array<ContactBody, 2> &bodies, double compliance, ConstraintRows &rows);

/// Two unit vectors across a unit vector, continuous in it except at one direction.
std::array<Eigen::Vector3d, 2> tangents(const Eigen::Vector3d &normal);
} // namespace pelvireg::registration
