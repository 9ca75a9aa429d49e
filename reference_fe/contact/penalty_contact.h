// Frictionless contact between outer surfaces.
#pragma once

#include "reference_fe/elements/surface_node.h"
#include "reference_fe/term.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace pelvireg::reference_fe
{
/// A triangulated surface that may touch others; outward.
struct ContactSurface
{
  std::string part;
  std::vector<SurfaceNode> vertices;
  std::vector<std::array<int, 3>> facets;
};

struct ContactOptions
{
  double penalty = 0.5;         ///< MPa/mm, slope of the traction at depth
  double onset = 0.2;           ///< mm, gap at which the traction begins (smoothly)
  double search_distance = 2.5; ///< mm, gap up to which a vertex is followed
  double settled_gap = 0.02;    ///< mm
};

/// Contact law: traction t(g)/penalty = (g0 - g)^2 / (4 g0) for |g| < g0, -g below, 0 above; energy and its derivatives
/// per area and penalty. Traction and slope are continuous; the linear law is reached at depth g0.
struct ContactLaw
{
  double energy = 0, d_energy = 0, d2_energy = 0;
};
ContactLaw contact_law(double gap, double onset);

/// Penalty contact, vertices of one surface against facets of the other, both ways (half weight each).
///
/// A vertex is paired with the closest facet that faces it; the pairing is frozen between calls of search(), so that
/// Newton's method sees a smooth problem with an exact tangent: gap = distance from the facet's plane. The load stepper
/// searches before a step and repeats the solution until the pairs in contact no longer change. Vertices beyond an
/// open border of a surface are left alone. What is closer than `onset` at rest (the border of the cervix patch)
/// keeps its rest clearance without traction.
class PenaltyContact : public Term
{
public:
  /// @param pairs indices of surfaces that may touch.
  PenaltyContact(std::vector<ContactSurface> surfaces, const std::vector<std::pair<int, int>> &pairs,
                 const ContactOptions &options);

  /// Pair vertices and facets at `solution`. True when the new pairs see another contact than the old ones: some vertex
  /// has a gap (counted up to the onset) that differs by more than settled_gap.
  bool search(const Eigen::VectorXd &solution);
  /// Deepest penetration of a vertex below the facet that it is paired with now, beyond that at rest, mm.
  double deepest_penetration(const Eigen::VectorXd &solution) const;
  /// Number of pairs that transmit traction.
  int n_in_contact(const Eigen::VectorXd &solution) const;

  std::string name() const override { return "contact"; }
  int n_items() const override { return static_cast<int>(pairs_.size()); }
  bool update(const Eigen::VectorXd &solution) override;
  void unknowns(int item, std::vector<int> &indices) const override;
  void evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const override;

private:
  /// Vertices of surface `vertex_side` against facets of surface `facet_side`.
  struct Pass
  {
    int vertex_side = 0, facet_side = 0;
    std::vector<double> clearance; ///< added to the gap of each vertex, mm: 0 but near the border of a tie
  };
  struct Pair
  {
    int pass = 0, vertex = 0, facet = 0;
    std::vector<SurfaceNode> nodes; ///< vertex, then the corners of the facet
    double clearance = 0, area = 0;
  };
  std::vector<Pair> find_pairs(const Eigen::VectorXd &solution) const;
  void find_pairs_of_pass(int pass, const std::vector<Eigen::Matrix3Xd> &x, std::vector<Pair> &pairs) const;
  double gap(const Pair &pair, const Eigen::VectorXd &solution) const;

  std::vector<ContactSurface> surfaces_;
  std::vector<std::vector<double>> vertex_areas_;       ///< rest area that a vertex stands for, mm^2
  std::vector<std::vector<std::array<bool, 3>>> border_; ///< of every facet: its edges (0 1), (1 2), (2 0) are open
  ContactOptions options_;
  std::vector<Pass> passes_;
  std::vector<Pair> pairs_;
  bool pairs_changed_ = false;
};
} // namespace pelvireg::reference_fe
