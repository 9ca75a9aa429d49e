// Frictionless contact between outer surfaces.
#pragma once

#include "reference_fe/contact/contact_surface.h"
#include "reference_fe/term.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace pelvireg::reference_fe
{
struct ContactOptions
{
  double penalty = 0.5;         ///< MPa/mm, slope of the traction at depth
  double onset = 0.2;           ///< mm, gap at which the traction begins (smoothly)
  double stiffening = 0;        ///< 1/mm, of the traction where surfaces penetrate
  double search_distance = 1.5; ///< mm, gap up to which a point is followed
  double settled_gap = 0.02;    ///< mm
};

/// What contact does at one integration point.
struct ContactTraction
{
  std::string part, other;  ///< the part that the point belongs to, and what presses on it
  Eigen::Vector3d position; ///< mm
  double traction = 0;      ///< MPa, of the whole contact (half of it is integrated here)
  double area = 0;          ///< mm^2 at rest
  double penetration = 0;   ///< mm, beyond that at rest; negative: gap
};

/// Where one part reaches deepest into another.
struct ContactPenetration
{
  double depth = 0; ///< mm, beyond that at rest; 0 when nothing penetrates
  std::string part, other;
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< mm
};

/// Penalty contact, surface to surface: the traction of contact_law() is integrated over the faces of either surface
/// (half weight each) against the curved faces of the other.
///
/// A point is paired with the face that carries the closest facet facing it; the pairing is frozen between calls of
/// search(), the projection onto that face is not: Newton's method sees a smooth problem with an exact tangent. The load
/// stepper searches before a step and repeats the solution until the pairs in contact no longer change. Points beyond an
/// open border of a surface are left alone. What is closer than `onset` at rest (the border of the cervix patch)
/// keeps its rest clearance without traction.
class PenaltyContact : public Term
{
public:
  /// @param pairs indices of surfaces that may touch.
  PenaltyContact(std::vector<ContactFaces> surfaces, const std::vector<std::pair<int, int>> &pairs,
                 const ContactOptions &options);

  /// Pair points and faces at `solution`. True when the new pairs see another contact than the old ones: some point
  /// has a gap (counted up to the onset) that differs by more than settled_gap.
  bool search(const Eigen::VectorXd &solution);
  /// Deepest penetration of an integration point or node into the face that it is paired with now. Points with less than
  /// half their traction are beside an open border or seen edge-on: they are not inside.
  ContactPenetration deepest_penetration(const Eigen::VectorXd &solution) const;
  /// All integration points that transmit traction.
  std::vector<ContactTraction> tractions(const Eigen::VectorXd &solution) const;
  /// Number of integration points that transmit traction.
  int n_in_contact(const Eigen::VectorXd &solution) const;

  std::string name() const override { return "contact"; }
  int n_items() const override { return static_cast<int>(face_pairs_.size()); }
  bool update(const Eigen::VectorXd &solution) override;
  void unknowns(int item, std::vector<int> &indices) const override;
  void evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const override;

private:
  /// Points of surface `point_side` against faces of surface `face_side`.
  struct Pass
  {
    int point_side = 0, face_side = 0;
    std::vector<double> clearance; ///< added to the gap of each point, mm: 0 but near the border of a tie
  };
  struct PairedPoint
  {
    int point = 0;
    Eigen::Vector2d start;  ///< reference coordinates where the projection begins
    double weight = 0;      ///< of its area, from 0 to 1: how much it faces the other surface
  };
  /// All points of one face that are paired with the same face of the other surface.
  struct FacePair
  {
    int pass = 0, own_face = 0, other_face = 0;
    std::vector<PairedPoint> points;
  };
  /// A point with its pairing.
  struct Pairing
  {
    int pass = 0, own_face = 0, other_face = 0;
    PairedPoint point;
  };
  using FacePositions = std::vector<std::vector<Eigen::Matrix3Xd>>; ///< of every surface and face

  std::vector<Pairing> find_pairings(const FacePositions &x) const;
  void find_pairings_of_pass(int pass, const FacePositions &x, std::vector<Pairing> &pairings) const;
  /// Group by faces; true when that needs other face pairs than before.
  bool adopt(std::vector<Pairing> pairings);
  /// Gap of a point with its clearance, mm; the onset where the projection leaves the face.
  double gap(const FacePair &pair, const PairedPoint &point, const FacePositions &x) const;
  /// The gaps below the onset, of every pass and point; the onset for all others.
  std::vector<std::vector<double>> gaps(const FacePositions &x) const;
  FacePositions positions(const Eigen::VectorXd &solution) const;
  std::vector<SurfaceNode> nodes(const FacePair &pair) const;
  const ContactPoint &contact_point(const FacePair &pair, const PairedPoint &point) const;

  std::vector<ContactSurface> surfaces_;
  ContactOptions options_;
  std::vector<Pass> passes_;
  std::vector<FacePair> face_pairs_; ///< ascending; some may have no point now
  bool pattern_changed_ = false;
};
} // namespace pelvireg::reference_fe
