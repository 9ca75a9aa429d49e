// anatomy.h5: everything that is known before anything moves.
#pragma once

#include "synthetic/dataset/geometry.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace pelvireg::dataset
{
/// Hyperelastic law of the reference: W = sum_i C_i0 (I1bar - 3)^i + kappa/2 (J - 1)^2. Neo-Hookean when C20 = C30 = 0.
struct YeohMaterial
{
  double c10 = 0, c20 = 0, c30 = 0; ///< MPa
  double kappa = 0;                 ///< bulk modulus, MPa
};

/// What holds the fluid in a cavity. The load parameter counts increments: 0 at rest, k at the end of increment k.
enum class CavityMode
{
  closed,  ///< its volume is kept
  leak,    ///< it flows out while its pressure is positive, at leak_rate times the pressure; nothing flows back
  pressure ///< its pressure grows in proportion to the load parameter, whatever volume that takes
};

struct CavityControl
{
  CavityMode mode = CavityMode::closed;
  double leak_rate = 0; ///< mm^3 per MPa and increment (leak)
  double pressure = 0;  ///< MPa, reached at the last increment (pressure)
};

/// A shell of the reference: mid-surface, quadratic quadrilaterals.
/// The outer surface is midsurface + thickness/2 * directors.
struct ReferenceShell
{
  std::string name;          ///< "bladder", "vagina", "rectum", "pelvic_floor"
  std::string material;      ///< key into ReferenceModel::materials
  Points midsurface;         ///< n x 3, mm
  Points directors;          ///< n x 3, unit outward normals (pelvic floor: cranial)
  Eigen::VectorXd thickness; ///< n, mm
  Quads9 cells;              ///< m x 9
  Integers region;           ///< m, SurfaceRegion of each cell (never cap: the wall ends at the rim)
  /// Share of the abdominal pressure at each node, 0 … 1, interpolated over the cells as positions are. Empty: 1 on the
  /// cells of region peritoneal, 0 elsewhere.
  Eigen::VectorXd pressure_share;
  Integers fixed_nodes; ///< nodes whose mid-surface displacement is zero
  /// Rims of the open ends, each an ordered closed loop of node indices (corner and mid-side nodes alternate).
  /// Empty for a closed shell. The cavity of the shell is bounded by zeta = -1 and by flat caps over these rims.
  std::vector<Integers> rims;
  bool has_cavity = false; ///< encloses an incompressible fluid
  CavityControl cavity;    ///< when it does
};

/// A solid of the reference: quadratic tetrahedra.
struct ReferenceSolid
{
  std::string name;               ///< "uterus"
  std::string material;           ///< key into ReferenceModel::materials
  Points points;                  ///< n x 3, mm
  Tets10 cells;                   ///< m x 10
  Triangles6 faces;               ///< k x 6, closed outward boundary
  Integers region;                ///< k, SurfaceRegion of each boundary face
  Eigen::VectorXd pressure_share; ///< n, as of a shell; only the boundary's count
  Integers fixed_nodes;           ///< may be empty
};

/// One straight bar from a node of a part to a fixed point in space, or to a node of another part.
struct ReferenceTruss
{
  std::string group;  ///< "cardinal_left", "fascia_pelvis", "hiatus", …
  std::string part_a; ///< shell or solid name
  std::int32_t node_a = 0;
  std::string part_b; ///< empty: the bar ends at `fixed_point`
  std::int32_t node_b = -1;
  Eigen::Vector3d fixed_point = Eigen::Vector3d::Zero(); ///< mm; used when part_b is empty
  double area = 0;                                       ///< mm^2
  std::string material;                                  ///< key into ReferenceModel::materials
  bool tension_only = false;                             ///< slack in compression
  /// mm, from node_b to where the bar ends at rest; the end moves as the node does. A bar between points that are no
  /// nodes is made of parallel ones.
  Eigen::Vector3d offset_b = Eigen::Vector3d::Zero();
};

/// What the reference solver needs beside the parts.
struct ReferenceModel
{
  std::map<std::string, YeohMaterial> materials;
  std::vector<ReferenceShell> shells;
  std::vector<ReferenceSolid> solids;
  std::vector<ReferenceTruss> trusses;
  /// Pairs of part names whose outer surfaces may touch. The cervix patches are left out of it: they are tied.
  std::vector<std::pair<std::string, std::string>> contact_pairs;
  /// Pairs (part, part) tied over their cells or faces of region cervix_patch.
  std::vector<std::pair<std::string, std::string>> ties;
  double target_displacement = 8.2; ///< mm, mean vaginal in-plane displacement at the last increment (DESIGN 4)
  int n_increments = 15;
  double contact_friction = 0; ///< reserved; the reference is frictionless
};

/// A body of the registration.
struct RegistrationBody
{
  std::string name;          ///< organ name, or "ligaments", "fascia_pelvis", "fascia_sacrum"
  Points points;             ///< n x 3, mm
  Tets tets;                 ///< organs; empty for grids
  Hexes hexes;               ///< grids; empty for organs
  double youngs_modulus = 0; ///< MPa
  double poisson_ratio = 0.45;
  double density = 1.05e-9; ///< t/mm^3
  /// Held in space: far ends of ligaments and fasciae; outer rims of the tubes' open ends, where the reference holds
  /// them too. Like every boundary condition, none of them acts in no_boundary_conditions.
  Integers fixed_nodes;
  /// Closed outward outer surface over `points`; caps use rim nodes only. Empty for grids.
  Triangles outer_triangles;
  Integers outer_region; ///< SurfaceRegion of each outer triangle
};

/// Nodes of body_a held on the outer surface of body_b (bilateral; the registration finds triangle and barycentric
/// coordinates itself).
struct RegistrationAttachment
{
  std::string name;   ///< "cardinal_left", "fascia_pelvis", "uterus_vagina", …
  std::string kind;   ///< "ligament", "fascia", "organ"
  std::string body_a; ///< the body whose nodes are attached
  Integers nodes_a;
  std::string body_b; ///< the organ that they are attached to
};

struct RegistrationModel
{
  std::vector<RegistrationBody> bodies; ///< bladder, vagina, uterus, rectum, fascia_pelvis, fascia_sacrum, ligaments
  std::vector<RegistrationAttachment> attachments;
};

/// Content of anatomy.h5.
struct Anatomy
{
  std::string case_name;
  Plane dyn_plane;
  int n_control_points = 70;        ///< total over the organs, about
  double control_point_spacing = 0; ///< mm along the rest contours; 0: from n_control_points
  double slice_pitch = 6.0;         ///< mm between validation slices
  int n_slices_each_side = 7;
  int registration_steps_per_increment = 3;
  double registration_time_step = 0.02; ///< s
  double registration_friction = 0;     ///< Coulomb's coefficient between the registration's organs
  ReferenceModel reference;
  RegistrationModel registration;
};

/// Write to a temporary name, fsync, rename. Throws std::runtime_error when the disk refuses.
void save(const Anatomy &anatomy, const std::filesystem::path &file);
/// Throws InputError when the file is missing, of another format or version, incomplete or inconsistent.
Anatomy load_anatomy(const std::filesystem::path &file);
} // namespace pelvireg::dataset
