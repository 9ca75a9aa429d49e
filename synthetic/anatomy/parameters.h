// Everything that a case file says, checked. Lengths mm, moduli MPa; points are LPS (x left, y posterior, z superior).
#pragma once

#include "synthetic/dataset/anatomy.h"

#include <map>
#include <string>
#include <vector>

namespace pelvireg::anatomy
{
struct BladderShape
{
  Eigen::Vector3d centre, semi_axes;    ///< semi-axes along x, y, z
  double dome_flattening = 0;           ///< fraction by which the top is lowered
  Eigen::Vector3d neck_direction;       ///< from the centre, in the space of the unit sphere
  double neck_length = 0;               ///< how far the neck is drawn out
  double neck_width = 0;                ///< rad, on the unit sphere
  Eigen::Vector3d impression_direction; ///< where the uterus lies on it
  double impression_depth = 0, impression_width = 0;
  double wall = 0;
  double peritoneal_above = 0, peritoneal_fade = 0; ///< the abdominal pressure sets in around this z, over this height
};

struct VaginaShape
{
  std::vector<Eigen::Vector3d> axis; ///< introitus to apex
  std::vector<double> fillet_radii;
  double half_depth = 0;
  std::vector<double> width_stations, widths; ///< fraction of the axis, total width
  double wall = 0;
};

struct UterusShape
{
  double patch_distance = 0; ///< from the vagina's apex back to the centre of the patch, along the axis
  Eigen::Vector3d internal_os, fundus;
  double fillet_radius = 0, deviation = 0; ///< deviation: degrees to the left
  double cervix_sleeve = 0;                ///< length over which the sections turn into the plane of the patch
  std::vector<double> stations, half_widths, half_depths; ///< fraction of the axis from the patch, semi-axes
  double fundus_length = 0;                               ///< axial semi-axis of the rounded fundus
  double peritoneal_from = 0, peritoneal_fade = 0;        ///< axial distance beyond the internal os, and over which
};

struct RectumShape
{
  std::vector<Eigen::Vector3d> axis; ///< anal margin to rectosigmoid
  std::vector<double> fillet_radii;
  std::vector<double> radius_stations, radii;
  double wall = 0;
  double peritoneal_above = 0, peritoneal_fade = 0; ///< as of the bladder
};

struct FloorShape
{
  std::vector<Eigen::Vector3d> hiatus, edge; ///< left halves, anterior to posterior midline, mirrored
  double sag = 0;                            ///< depth of the bowl below the straight line from hiatus to edge
  double thickness = 0;
  double edge_radius = 0; ///< mm, with which the floor turns down over the bone at its edge; 0: it ends there
};

/// A ligament or fascia, left and right: one patch-to-patch geometry for the bars and the hexahedral band.
struct Support
{
  std::string name, body, kind, organ, material;
  Eigen::Vector3d organ_point, organ_span, far_point, far_span; ///< left side; the right one is mirrored in x
  double area_left = 0, area_right = 0;                         ///< mm^2, total section a side
  int n_bars = 8;
  bool tension_only = false;   ///< the bars slacken in compression; the band never does
  std::vector<int> band_cells; ///< along, across, through the thickness
};

/// The fluid of bladder, vagina or rectum.
struct CavityFilling
{
  bool is_open = false; ///< no fluid: only the wall
  dataset::CavityControl control;
};

struct Parameters
{
  std::string name, description;
  double plane_offset = 0, plane_tilt = 0; ///< mm to the left, degrees
  Eigen::Vector3d plane_centre;
  double target_displacement = 0;
  int n_increments = 15, n_control_points = 70, steps_per_increment = 3;
  /// mm, from where a ligament or fascia really meets its organ (left side; mirrored in x on the right) to where the
  /// registration believes it does.
  Eigen::Vector3d insertion_shift = Eigen::Vector3d::Zero();
  double time_step = 0.02, friction_coefficient = 0; ///< of the registration, s, -
  double slice_pitch = 6;
  int n_slices_each_side = 7;

  std::map<std::string, double> cell_size; ///< mm, of the truth's mesh by part
  std::map<std::string, int> registration_nodes;
  std::map<std::string, double> youngs_modulus;
  double poisson_ratio = 0.45, density = 1.05e-9;

  std::map<std::string, dataset::YeohMaterial> materials;
  std::map<std::string, std::string> material_of;

  BladderShape bladder;
  VaginaShape vagina;
  UterusShape uterus;
  RectumShape rectum;
  FloorShape pelvic_floor;
  std::vector<Support> supports;
  std::map<std::string, CavityFilling> cavities; ///< organs that the case names; the others are closed

  Eigen::Vector3d urethra_far;                                         ///< fixed distal end of the urethra
  double urethra_area = 0, urethra_radius = 0, urethra_far_radius = 0; ///< radii at the bladder and at the far end
  int urethra_bars = 0;
  Eigen::Vector3d retropubic_normal; ///< unit, from the symphysis towards the bladder
  double retropubic_depth = 0, retropubic_area = 0, retropubic_half_width = 0; ///< of the fatty space of Retzius
  double hiatus_reach = 0;                                                     ///< longest bar of the perineal membrane
  double hiatus_area_per_length = 0; ///< mm^2 of the membrane's section a mm of the hiatus' rim
};

/// Parse and check a case text. Throws InputError.
Parameters read_parameters(const std::string &text, const std::string &case_name);
} // namespace pelvireg::anatomy
