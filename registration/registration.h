// The system under test: real-time corotational registration driven by the outlines in one image plane.
// Plain arrays in and out. Units: mm, N, MPa, s, t. Paper: sections 5.1 and 5.2.
#pragma once

#include "registration/mutation.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace pelvireg::registration
{
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Tets = Eigen::Matrix<int, Eigen::Dynamic, 4, Eigen::RowMajor>;
using Hexes = Eigen::Matrix<int, Eigen::Dynamic, 8, Eigen::RowMajor>;

/// One deformable body: tetrahedra or hexahedra, never both.
struct Body
{
  std::string name;
  Points rest_positions;     ///< n x 3, mm
  Tets tets;                 ///< positive volume
  Hexes hexes;               ///< VTK order
  double youngs_modulus = 0; ///< MPa
  double poisson_ratio = 0.45;
  double density = 1.05e-9;     ///< t/mm^3
  std::vector<int> fixed_nodes; ///< 0-based; those of an organ are anatomical constraints (Options::use_attachments)
  Triangles outer_triangles;    ///< closed, outward; empty for a body that is never matched or attached to
  /// One flag a triangle: control points may be matched to it and attachments may hold on it. Caps are not.
  std::vector<char> is_wall;
};

/// Nodes of one body held on the outer surface of another: bilateral, barycentric, 3 rows a node.
struct Attachment
{
  std::string name;
  int body_a = 0;
  std::vector<int> nodes_a;
  int body_b = 0;
  double compliance = 0; ///< mm/N, per row
};

/// Nodes of one body held at points in space: landmarks, bone that moves, a handle. Bilateral, 3 rows a node.
struct PointAttachment
{
  std::string name;
  int body = 0;
  std::vector<int> nodes;
  Points points;         ///< one a node, mm; Registration::move_points() moves them
  double compliance = 0; ///< mm/N, per row
};

/// Two organs whose outer surfaces may touch. Where an attachment joins them they are held and not in contact.
struct ContactPair
{
  int body_a = 0, body_b = 0;
};

struct Model
{
  std::vector<Body> bodies;
  std::vector<Attachment> attachments;
  std::vector<PointAttachment> point_attachments;
  std::vector<ContactPair> contact_pairs;
};

/// Control points of one organ in the image plane.
struct OutlineObservation
{
  int body = 0;
  Points points;  ///< k x 3, mm
  Points normals; ///< k x 3, unit, in the plane, outward
};

/// One dynamic image: the plane and the outlines seen in it.
struct Observation
{
  Eigen::Vector3d plane_origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d plane_normal = Eigen::Vector3d::UnitX(); ///< unit
  std::vector<OutlineObservation> outlines;
};

struct Options
{
  /// h of equation 8, s, > 0. M / h^2 is all that holds a floating organ across the image plane; no velocity is
  /// carried, so it acts as damping and not as inertia. Of 0.02, 0.01, 0.005 and 0.0025 s the third is the largest at
  /// which a smaller one no longer lowers the in-plane residual after three steps, with and without attachments.
  double time_step = 0.005;
  /// Anatomical constraints chi, the bodies that only serve them, and the fixed nodes of organs. An organ is a body
  /// with outer triangles.
  bool use_attachments = true;
  double max_match_distance = 30;    ///< mm: a control point whose nearest compatible triangle is farther is refused
  double min_normal_agreement = 0.5; ///< least cosine between the contour's and the triangle's in-plane normal
  /// mm/N, per sliding row. Rows carry about 1 N (5 N at most): 0.02 lets an outline lie off by about 0.02 mm, far
  /// below the noise of an image, and keeps redundant or antagonist control points from tearing at each other. 0
  /// demands exactness and is safe only when control points are sparser than nodes.
  double sliding_compliance = 0.02;
  double attachment_compliance = 0; ///< mm/N, per attachment row (added to Attachment::compliance)
  bool use_contact = true;          ///< contact phi of Model::contact_pairs
  /// Coulomb, between organs; 0: organs slide freely. It stands for the connective tissue that keeps organs from
  /// sliding along each other (paper, section 5.1). No coefficient is published. Of 0, 0.1, 0.3, 0.6, 1 and 2 the
  /// outlines are followed best with 0.6 (docs/study.md).
  double friction_coefficient = 0.6;
  double contact_pixel = 1; ///< mm between the rays that see overlaps, >= 0.05
  double contact_cell = 8;  ///< mm, edge of the cells in which overlap is gathered into one contact
  /// mm: surfaces this near are watched, so that what touches stays in contact. About as much as facets lie inside the
  /// curved walls (7 mm on a radius of 11 mm: 0.55 mm), so that a patch of contact is about as wide as a facet: a
  /// narrower one turns its normal with every facet that it passes, and does not come to rest.
  double contact_margin = 0.5;
  double contact_compliance = 1e-3; ///< mm/N, per contact row
  double max_recovery = 1;          ///< mm: the most by which one step drives overlapping bodies apart in a cell
  int max_sweeps = 500;
  double tolerance_mm = 1e-6;     ///< the constraint solve stops when the largest change of a row's gap is below …
  double tolerance_newton = 1e-4; ///< … and, for contacts, the largest change of a force
  int n_threads = 1;              ///< results are bit-identical for every value
  /// Memory is set aside in prepare(): no step with at most so many control points and contacts, on surfaces at most
  /// half as large again as at rest, allocates. A larger one does, once.
  int reserved_control_points = 128;
  int reserved_contacts = 64;
  Mutation mutation = {}; ///< for tests of the regression gate alone

  /// All problems as sentences; empty when the options are usable.
  std::vector<std::string> violations() const;
};

enum class StepStatus
{
  ok,
  no_control_points, ///< no control point was offered or accepted, and the model has no point attachment in use:
                     ///< nothing drives the step, positions unchanged
  not_finite,        ///< NaN in the observation or the solution: positions unchanged
  diverged,          ///< a node leaves the model's neighbourhood (its box, three times as large): positions unchanged
  factorisation_failed, ///< positions unchanged
  invalid_observation ///< unknown body, body without outer surface, unequal counts or a plane normal that is not unit:
                      ///< positions unchanged
};

/// A sentence a status, for files and tables.
std::string to_string(StepStatus status);

/// What one step says of itself. Residuals are measured after the step on a fresh matching.
struct StepSummary
{
  StepStatus status = StepStatus::ok;
  int offered_control_points = 0;
  int accepted_control_points = 0;
  double mean_in_plane_residual = 0; ///< mm, over the accepted control points
  double max_in_plane_residual = 0;  ///< mm
  double attachment_residual = 0;    ///< mm, largest norm over attached nodes
  double out_of_plane_force = 0;     ///< N, largest |(H^T lambda) . plane normal| of a node over the sliding rows
  double in_plane_force = 0;         ///< N, largest in-plane norm of the same
  int sweeps = 0; ///< over the contacts; without contacts 1 for the direct solution, more when it was refined
  double largest_motion = 0;          ///< mm, of a node in this step
  double unbalanced_force = 0;        ///< N, largest of a free node before the step: elastic and constraint forces
  int n_contacts = 0;                 ///< constraints of overlap or nearness offered to the solver
  double contact_force = 0;           ///< N, sum of the normal forces
  double contact_motion_residual = 0; ///< mm, of the natural map of contact and friction; see ContactResidual
  double contact_force_residual = 0;  ///< N, same
  double complementarity = 0;         ///< N mm, largest product of a contact's force and separation
  double cone_violation = 0;          ///< N, largest excess of a friction force over mu times the normal force
  double penetration_depth = 0;       ///< mm, deepest overlap after the step over all pairs, seen by the rays
  double penetration_volume = 0;      ///< mm^3, sum over the pairs
  int n_open_rays = 0;                ///< rays that crossed a surface inward and outward unequally often: left out
};

/// One pair after the last step; overlap as the rays see it, without what is attached.
struct PairPenetration
{
  int body_a = 0, body_b = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero(); ///< N, on body a, friction included
  double depth = 0;                                ///< mm, across the surfaces
  double volume = 0;                               ///< mm^3
  int n_contacts = 0;
  int n_open_rays = 0;
};

/// When settle() may stop: both must hold.
struct EquilibriumTolerance
{
  double motion_mm = 1e-3;    ///< StepSummary::largest_motion
  double force_newton = 1e-2; ///< StepSummary::unbalanced_force
  int max_steps = 1000;
};

struct Equilibrium
{
  bool is_reached = false;
  int n_steps = 0;
  StepSummary last_step;
};

/// Wall time of the last step by phase, ms; 0 for phases that a step which failed did not end. Kept apart from
/// StepSummary, which is the same on every run.
struct PhaseTimes
{
  double match = 0;    ///< matching, attachment rows
  double assemble = 0; ///< rotations, forces, matrices
  double factorise = 0;
  double free_motion = 0;
  double compliance = 0; ///< W
  double solve = 0;      ///< multipliers
  double correct = 0;
  double summarise = 0; ///< residuals on a fresh matching
  double contact = 0;   ///< detection, for the step's summary and the next step's rows
};

/// A phase of a step, for files and tables: what it is called there, and its time.
struct StepPhase
{
  const char *name;  ///< in files
  const char *title; ///< for people
  double PhaseTimes::*time;
};

/// All of PhaseTimes, in the order in which a step runs them.
inline constexpr std::array<StepPhase, 9> step_phases = {{
    {"match", "matching", &PhaseTimes::match},
    {"assemble", "assembly", &PhaseTimes::assemble},
    {"factorise", "factorisation", &PhaseTimes::factorise},
    {"free_motion", "free motion", &PhaseTimes::free_motion},
    {"compliance", "compliance W", &PhaseTimes::compliance},
    {"solve", "constraint forces", &PhaseTimes::solve},
    {"correct", "correction", &PhaseTimes::correct},
    {"summarise", "residuals", &PhaseTimes::summarise},
    {"contact", "contact detection", &PhaseTimes::contact},
}};

/// Size of the prepared system, over the bodies that take part.
struct SystemSize
{
  int n_unknowns = 0;
  long n_factor_values = 0; ///< doubles stored for the Cholesky factors, 8 bytes each
};

/// The registration. Not copyable; movable. update() allocates nothing up to the capacities in Options.
class Registration
{
public:
  Registration();
  ~Registration();
  Registration(Registration &&) noexcept;
  Registration &operator=(Registration &&) noexcept;

  /// Check the model, build matrices and symbolic factors. Throws std::invalid_argument with one clear sentence for
  /// bad options, an inverted element, an index out of range or an open outer surface.
  void prepare(const Model &model, const Options &options);

  /// One simulation step (paper, equations 7 to 10). prepare() must have been called. A numerical failure is a status,
  /// never an exception; the positions keep the last valid state.
  StepSummary update(const Observation &observation);

  /// Move the points of Model::point_attachments[attachment] for the next steps: n x 3, mm, as many as it has nodes.
  /// Throws std::invalid_argument with one sentence for an unknown attachment, another number of points or a point that
  /// is not finite.
  void move_points(int attachment, const Points &points);

  /// Static mode: steps on one image until nothing moves and forces balance. Steps keep their time step h, which does
  /// not influence the equilibrium (paper, section 5.2), with friction either. Stops at a failed step,
  /// whose status is in last_step. Throws std::invalid_argument for tolerances that are not positive.
  Equilibrium settle(const Observation &observation, const EquilibriumTolerance &tolerance = {});

  /// Overlap of every pair of Model::contact_pairs after the last step (after prepare(): at rest); empty when contact
  /// is not used.
  const std::vector<PairPenetration> &penetrations() const;

  /// Unknowns and memory of the prepared model.
  SystemSize system_size() const;

  /// Current positions of a body (index into Model::bodies), n x 3, mm. A body that takes no part stays at rest.
  const Points &positions(int body) const;

  /// Wall time of the last update().
  const PhaseTimes &phase_times() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};
} // namespace pelvireg::registration
