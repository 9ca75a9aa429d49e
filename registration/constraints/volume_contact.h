// Contact constraints phi of two bodies: the volume in which they overlap, cell by cell (paper, section 5.1, equation
// 5; Allard, Faure, Courtecuisse, Falipou, Duriez, Kry, "Volume contact constraints at arbitrary resolution", ACM
// Trans. Graph. 29, 2010).
#pragma once

#include "registration/constraints/contact_spans.h"
#include "registration/constraints/layered_depth_image.h"
#include "registration/constraints/triangle_tree.h"
#include "registration/registration.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pelvireg::registration
{
/// A body's surface as contact sees it.
struct ContactSurface
{
  const Triangles *triangles = nullptr;         ///< closed, outward
  const Points *positions = nullptr;            ///< mm, of all nodes
  const std::vector<char> *may_touch = nullptr; ///< a flag a triangle; the others only close the surface
  const TriangleTree *walls = nullptr;          ///< refitted to the positions: overlap is as deep as its way to these
};

struct ContactGrid
{
  double pixel = 1;  ///< mm between rays
  double cell = 8;   ///< mm, edge of the cubes (fixed in space) in which overlap is gathered into one constraint
  double margin = 0; ///< mm: gaps below it take part, with a weight that falls to zero at it
};

/// A node's share in a contact.
struct ContactShare
{
  int side = 0; ///< 0: body a, 1: body b
  int node = 0;
  Eigen::Vector3d normal_jacobian = Eigen::Vector3d::Zero(); ///< d(separation) / d(position)
  double weight = 0; ///< of the mean motion of the side's touching surface; the sum over a side is 1
};

/// The overlap within one cell.
struct Contact
{
  std::int64_t cell = 0;                            ///< names the cell; the same at every step
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< unit: where body a must go to separate
  double area = 0;                                  ///< mm^2, of the touching surface across the normal
  double depth = 0;                                 ///< mm: overlap volume / area, gaps counted negative
  int first_share = 0, end_share = 0;               ///< range of VolumeContact::shares()
};

/// Finds the contacts of one pair of bodies.
///
/// Along each axis, rays one `pixel` apart see where the bodies overlap. A ray's overlap adds its length times the
/// pixel's area to the volume of the cell in which its middle lies. The volume's gradient with respect to a node is the
/// integral of (barycentric weight) x (outward normal) over the overlap's boundary; its component along an axis is
/// taken from the rays along that axis, for which the projected area of a surface element is the pixel's: exact up to
/// that quadrature, without a division by a slope. Both ends of a ray's overlap push with the same force along the same
/// line, so every contact's action is its reaction, in force and moment. The volume is a mean of the three axes'
/// volumes, weighted with the squared components of the cell's normal: rays that graze the touching surfaces see
/// little.
///
/// A body that lies wholly inside the other has no gradient that would push it out; it is driven out along the axis and
/// in the direction on which it has the shortest way.
class VolumeContact
{
public:
  /// Number of nodes of the two bodies.
  VolumeContact(int n_nodes_a, int n_nodes_b);

  /// Set memory aside for so many contacts between these surfaces, in any position and half as large again.
  void reserve(const ContactSurface &a, const ContactSurface &b, const ContactGrid &grid, std::size_t n_contacts);
  /// How many nodes share a contact, at most, in the memory set aside: a cell holds some facets of either surface.
  static constexpr std::size_t reserved_shares = 128;

  /// Overlap of the surfaces as they are now; positions must be finite.
  void detect(const ContactSurface &a, const ContactSurface &b, const ContactGrid &grid);

  const std::vector<Contact> &contacts() const { return contacts_; } ///< by ascending cell
  const std::vector<ContactShare> &shares() const { return shares_; }
  double overlap_volume() const { return overlap_volume_; } ///< mm^3, of the surfaces that may touch
  /// mm: of the points where rays see one body inside the other, the largest distance to this other's walls.
  double deepest_overlap() const { return deepest_overlap_; }
  int n_open_rays() const { return n_open_rays_; } ///< rays that a surface stops from closing: left out

private:
  struct Column
  {
    std::int64_t cell = 0;
    int axis = 0;
    const Fragment *entry = nullptr, *exit = nullptr;
    double length = 0;        ///< mm, along the axis
    double weighted_area = 0; ///< mm^2
  };

  void cast_rays(const std::array<ContactSurface, 2> &surfaces, const ContactGrid &grid);
  void add_column(const ContactSpan &span, const std::array<ContactSurface, 2> &surfaces, const ContactGrid &grid,
                  const LayeredDepthImage &image, const Eigen::Vector2d &centre, bool is_pushed_out);
  void measure_depth(const ContactSpan &span, const std::array<ContactSurface, 2> &surfaces,
                     const LayeredDepthImage &image, const Eigen::Vector2d &centre);
  void push_out_nested(const std::array<ContactSurface, 2> &surfaces, const ContactGrid &grid);
  void gather_cells(const std::array<ContactSurface, 2> &surfaces);
  void gather_cell(std::size_t first, std::size_t end, const std::array<ContactSurface, 2> &surfaces);
  void share_out(const Column &column, const Fragment &fragment, const Triangles &triangles, double sign,
                 const Contact &contact);

  /// A nested overlap and the ray that saw it.
  struct Nested
  {
    ContactSpan span;
    int axis = 0;
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  };

  std::array<LayeredDepthImage, 3> images_;
  std::vector<ContactSpan> spans_;
  std::vector<Column> columns_;
  std::vector<Nested> nested_;
  std::vector<int> order_;
  std::vector<Contact> contacts_;
  std::vector<ContactShare> shares_;
  std::array<std::vector<int>, 2> share_of_; ///< index into shares_ of each node in the present cell; -1: none
  double overlap_volume_ = 0, deepest_overlap_ = 0;
  int n_open_rays_ = 0;
};
} // namespace pelvireg::registration
