#include "validation/runner/outer_surface.h"

#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <cstddef>

namespace pelvireg::runner
{
dataset::Points OuterSurface::pick(const dataset::Points &body_positions) const
{
  dataset::Points picked(static_cast<Eigen::Index>(nodes.size()), 3);
  for (Eigen::Index i = 0; i < picked.rows(); ++i)
    picked.row(i) = body_positions.row(nodes[static_cast<std::size_t>(i)]);
  return picked;
}

OuterSurface outer_surface(const dataset::RegistrationBody &body)
{
  if (body.outer_triangles.rows() == 0)
    throw InputError(fmt::format("anatomy: registration body '{}' has no outer triangles, an organ needs them; "
                                 "generate the anatomy again",
                                 body.name));
  if (body.outer_triangles.minCoeff() < 0 || body.outer_triangles.maxCoeff() >= body.points.rows() ||
      body.outer_region.size() != body.outer_triangles.rows())
    throw InputError(
        fmt::format("anatomy: outer triangles of '{}' have indices from {} to {} for {} nodes and {} region "
                    "codes for {} triangles; generate the anatomy again",
                    body.name, body.outer_triangles.minCoeff(), body.outer_triangles.maxCoeff(), body.points.rows(),
                    body.outer_region.size(), body.outer_triangles.rows()));

  std::vector<int> surface_node(static_cast<std::size_t>(body.points.rows()), -1);
  for (const int node : body.outer_triangles.reshaped())
    surface_node[static_cast<std::size_t>(node)] = 0;
  OuterSurface surface;
  for (std::size_t node = 0; node < surface_node.size(); ++node)
    if (surface_node[node] == 0)
    {
      surface_node[node] = static_cast<int>(surface.nodes.size());
      surface.nodes.push_back(static_cast<int>(node));
    }
  surface.rest.points = surface.pick(body.points);
  surface.rest.triangles =
      body.outer_triangles.unaryExpr([&](std::int32_t node) { return surface_node[static_cast<std::size_t>(node)]; });
  surface.rest.region = body.outer_region;
  return surface;
}

int body_index(const dataset::RegistrationModel &model, const std::string &name)
{
  std::string found;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
  {
    if (model.bodies[i].name == name)
      return static_cast<int>(i);
    found += (found.empty() ? "" : ", ") + model.bodies[i].name;
  }
  throw InputError(fmt::format("anatomy: registration body '{}' is missing, got: {}; generate the anatomy again", name,
                               found.empty() ? "none" : found));
}
} // namespace pelvireg::runner
