// What a model must fulfil before it can be simulated.
#pragma once

#include "registration/registration.h"

namespace pelvireg::registration
{
/// Throws std::invalid_argument with one sentence (what, where, got, allowed, remedy) for: a body with both or neither
/// kind of element, a value out of range, an index out of range, a position that is not finite, a node in no element,
/// an inverted or flat element, a disconnected organ, an outer surface that is open, not manifold or inward, an
/// attachment to a body without wall triangles, a point attachment that is not a finite point a node, a contact pair
/// that is not two organs or is named twice.
void check_model(const Model &model);

/// Throws std::invalid_argument when there are not n points or one is not finite; `where` starts the sentence.
void check_points(const std::string &where, std::size_t n, const Points &points);

/// True for a body that control points may be matched to (it has an outer surface). Any other body only serves the
/// anatomical constraints.
inline bool is_organ(const Body &body)
{
  return body.outer_triangles.rows() > 0;
}
} // namespace pelvireg::registration
