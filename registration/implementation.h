// What a prepared registration holds, and the phases of its step.
#pragma once

#include "registration/constraints/attachment.h"
#include "registration/constraints/contact_memory.h"
#include "registration/constraints/point_attachment.h"
#include "registration/constraints/sliding.h"
#include "registration/constraints/volume_contact.h"
#include "registration/registration.h"
#include "registration/solver/body_solver.h"
#include "registration/solver/body_threads.h"
#include "registration/solver/constraint_solver.h"

#include <array>
#include <vector>

namespace pelvireg::registration
{
struct Registration::Implementation
{
  Implementation(const Model &model, const Options &options);

  StepSummary update(const Observation &observation);

  // Phases of a step, in order (step.cc, contact_phase.cc).
  StepStatus check(const Observation &observation) const;
  void follow_image(const Observation &observation);
  void match_outlines(const Observation &observation);
  void linearise_constraints(StepSummary &summary);
  void add_contacts(StepSummary &summary);
  bool factorise_bodies();
  void guess_contact_forces();
  bool solve_constraints(StepSummary &summary);
  StepStatus correct_bodies(StepSummary &summary);
  void remember_contact_forces(StepSummary &summary);
  void detect_contacts();
  // What the step says of itself (step_summary.cc).
  void measure_forces(const Observation &observation, StepSummary &summary);
  void measure_residuals(const Observation &observation, StepSummary &summary);
  void measure_contact(StepSummary &summary);

  void add_pair(const Model &model, const ContactPair &pair);
  void reserve_memory();
  void add_row_forces(int first_row, int end_row);
  bool has_friction() const { return options.friction_coefficient > 0; }

  struct Match
  {
    int body = 0;
    SlidingMatch sliding;
  };

  /// Two organs that may touch.
  struct TouchingPair
  {
    std::array<int, 2> bodies{0, 0};
    std::array<std::vector<char>, 2> may_touch; ///< a flag an outer triangle: neither a cap nor attached to the other
    VolumeContact contact;
  };

  ContactSurface contact_surface(const TouchingPair &pair, int side) const;
  ContactGrid contact_grid() const { return {options.contact_pixel, options.contact_cell, options.contact_margin}; }

  Options options;
  std::vector<BodySolver> bodies;
  std::vector<TriangleTree> trees;       ///< wall triangles, one a body
  std::vector<Triangles> outer_surfaces; ///< one a body
  std::vector<int> active;               ///< bodies that take part, the largest first
  std::vector<AttachedNode> attached_nodes;
  std::vector<std::size_t> n_held_nodes;         ///< of every point attachment, used or not
  std::vector<std::vector<HeldNode>> held_nodes; ///< of every point attachment; empty ones when they are not used
  std::vector<TouchingPair> pairs;
  std::vector<int> pair_order;
  BodyThreads threads;
  Eigen::AlignedBox3d neighbourhood; ///< beyond it a solution has diverged

  std::vector<Match> matches;
  ConstraintRows rows;
  int n_bilateral_rows = 0;
  ConstraintSolver constraint_solver;
  ContactMemory contact_memory;
  std::vector<double> image, last_image; ///< what the present and the last image show
  bool has_moved_points = false;         ///< since the last step
  std::vector<Points> slip_origins;      ///< one a body: positions when what drives the organs last changed
  std::vector<double> remaining_gaps;    ///< after the free motion, mm, one a row
  std::vector<char> succeeded;           ///< a flag a body
  std::vector<Points> nodal_forces;
  std::vector<PairPenetration> penetrations;
  PhaseTimes times;
};
} // namespace pelvireg::registration
