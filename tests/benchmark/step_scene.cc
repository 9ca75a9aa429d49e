#include "tests/benchmark/step_scene.h"

#include <Eigen/Dense>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <stdexcept>

namespace pelvireg::bench
{
namespace
{
using namespace registration;

constexpr double body_mass = 5e-5; // t

[[noreturn]] void fail(const std::string &file, const std::string &what)
{
  throw std::runtime_error("step scene: " + file + ": " + what);
}

/// Reads the section that starts with `keyword`; its header's other words are skipped.
int read_header(std::ifstream &in, const std::string &file, const std::string &keyword, int n_words_behind)
{
  std::string word;
  while (in >> word)
    if (word == keyword)
    {
      int count = 0;
      in >> count;
      for (int k = 0; k < n_words_behind; ++k)
        in >> word;
      if (in && count > 0)
        return count;
      break;
    }
  fail(file, "has no section " + keyword + " with a positive count; give a legacy VTK unstructured grid");
}

void read_mesh(const std::string &file, Body &body)
{
  std::ifstream in(file);
  if (!in)
    fail(file, "cannot be read; give the folder of a step scene");
  constexpr int type_of_coordinates = 1, size_of_list = 1;
  body.rest_positions.resize(read_header(in, file, "POINTS", type_of_coordinates), 3);
  for (double &coordinate : body.rest_positions.reshaped<Eigen::RowMajor>())
    in >> coordinate;
  body.tets.resize(read_header(in, file, "CELLS", size_of_list), 4);
  for (Eigen::Index t = 0; t < body.tets.rows(); ++t)
  {
    int n_nodes = 0;
    in >> n_nodes;
    if (n_nodes != 4)
      fail(file, "cell " + std::to_string(t) + " has " + std::to_string(n_nodes) +
                     " nodes, must have 4; give tetrahedra only");
    for (int a = 0; a < 4; ++a)
      in >> body.tets(t, a);
  }
  if (!in)
    fail(file, "ends within its points or cells; write it again");
}

double volume_of(const Body &body)
{
  double volume = 0;
  for (Eigen::Index t = 0; t < body.tets.rows(); ++t)
  {
    const auto corner = [&](int a) -> Eigen::RowVector3d { return body.rest_positions.row(body.tets(t, a)); };
    volume += (corner(1) - corner(0)).cross(corner(2) - corner(0)).dot(corner(3) - corner(0)) / 6;
  }
  return volume;
}
} // namespace

Model read_step_scene(const std::string &folder)
{
  const std::string file = folder + "/scene.json";
  std::ifstream in(file);
  if (!in)
    fail(file, "cannot be read; give the folder of a step scene");
  Model model;
  try
  {
    const nlohmann::json scene = nlohmann::json::parse(in);
    for (const nlohmann::json &described : scene.at("bodies"))
    {
      Body &body = model.bodies.emplace_back();
      body.name = described.at("name").get<std::string>();
      read_mesh(folder + "/" + body.name + ".vtk", body);
      body.youngs_modulus = described.at("E").get<double>();
      body.poisson_ratio = described.at("nu").get<double>();
      body.density = body_mass / volume_of(body);
      body.fixed_nodes = described.at("fixed").get<std::vector<int>>();
      PointAttachment &pulled = model.point_attachments.emplace_back();
      pulled.name = body.name + " to its targets";
      pulled.body = static_cast<int>(model.bodies.size()) - 1;
      pulled.nodes = described.at("attached").get<std::vector<int>>();
      const auto targets = described.at("target").get<std::vector<std::array<double, 3>>>();
      pulled.points.resize(static_cast<Eigen::Index>(targets.size()), 3);
      for (std::size_t k = 0; k < targets.size(); ++k)
        pulled.points.row(static_cast<Eigen::Index>(k)) << targets[k][0], targets[k][1], targets[k][2];
    }
  }
  catch (const nlohmann::json::exception &error)
  {
    fail(file, error.what());
  }
  return model;
}

Options step_scene_options()
{
  Options options;
  options.time_step = 0.02;
  options.max_sweeps = 100;
  options.tolerance_mm = 1e-6;
  return options;
}
} // namespace pelvireg::bench
