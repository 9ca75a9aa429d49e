// A surface that may touch others: its facets for the search, its points for the integration.
#pragma once

#include "reference_fe/contact/facet_tree.h"
#include "reference_fe/elements/surface_face.h"

#include <array>
#include <string>
#include <vector>

namespace pelvireg::reference_fe
{
/// What the caller gives: curved faces, outward.
struct ContactFaces
{
  std::string part;
  std::vector<SurfaceFace> faces;
  /// Contact fades out towards open borders. False: the body goes on beyond them (planes of symmetry).
  bool ends_at_borders = true;
};

/// A material point of a face whose gap is followed.
struct ContactPoint
{
  int face = 0;
  Eigen::VectorXd shape;         ///< N on its face
  Eigen::VectorXd d_xi, d_eta;   ///< derivatives
  double area = 0;               ///< rest area that it stands for, mm^2; 0: only the depth is looked at
};

/// A triangle between nodes of a face.
struct ContactFacet
{
  int face = 0;
  std::array<int, 3> nodes{};     ///< of the face
  std::array<bool, 3> is_border{}; ///< edges (0 1), (1 2), (2 0) belong to no other facet
};

/// Faces with integration points: nine a quarter of a quadrilateral, three a quarter of a triangle, on the quarters'
/// edges too.
class ContactSurface
{
public:
  explicit ContactSurface(ContactFaces faces);

  const std::string &part() const { return part_; }
  const std::vector<SurfaceFace> &faces() const { return faces_; }
  const std::vector<ContactPoint> &points() const { return points_; }
  const std::vector<ContactFacet> &facets() const { return facets_; }

  std::vector<Eigen::Matrix3Xd> rest_positions() const;                             ///< of the nodes of every face, mm
  std::vector<Eigen::Matrix3Xd> positions(const Eigen::VectorXd &solution) const; ///< the same, moved
  /// The facets' tree at given positions of the faces' nodes.
  FacetTree tree(const std::vector<Eigen::Matrix3Xd> &x) const;

private:
  void add_facets(int face);
  void add_points(int face);
  void mark_borders();

  std::string part_;
  std::vector<SurfaceFace> faces_;
  std::vector<ContactPoint> points_;
  std::vector<ContactFacet> facets_;
};
} // namespace pelvireg::reference_fe
