// mesh_study.json: a discretisation error with its provenance.
#include "validation/cli/mesh_study_file.h"
#include "synthetic/anatomy/case.h"
#include "synthetic/dataset/error.h"
#include "validation/cli/sha256.h"
#include "validation/cli/studies.h"
#include "validation/cli/version.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace pelvireg::cli
{
namespace
{
using dataset::DiscretisationError;
using json = nlohmann::ordered_json;

std::vector<double> numbers(const Eigen::VectorXd &values)
{
  return {values.begin(), values.end()};
}

Eigen::VectorXd vector_from(const json &list)
{
  const auto values = list.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

dataset::Points4 by_organ_from(const json &organs)
{
  dataset::Points4 values;
  for (std::size_t organ = 0; organ < dataset::organ_names.size(); ++organ)
  {
    const Eigen::VectorXd column = vector_from(organs.at(dataset::organ_names[organ]));
    values.conservativeResize(column.size(), 4);
    values.col(static_cast<Eigen::Index>(organ)) = column;
  }
  return values;
}

json by_organ(const dataset::Points4 &values)
{
  json organs;
  for (std::size_t organ = 0; organ < dataset::organ_names.size(); ++organ)
    organs[dataset::organ_names[organ]] = numbers(values.col(static_cast<Eigen::Index>(organ)));
  return organs;
}
} // namespace

std::string mesh_study_text(const std::string &case_name, const DiscretisationError &error)
{
  const std::vector<int> n_cells(error.n_cells.begin(), error.n_cells.end());
  const json study = {{"format", "pelvireg mesh study"},
                      {"case_name", case_name},
                      {"case_sha256", error.case_sha256},
                      {"solver_sha256", error.solver_sha256},
                      {"revision", error.revision},
                      {"build", build()},
                      {"cell_sizes_mm", numbers(error.cell_sizes)},
                      {"n_cells", n_cells},
                      {"observed_order", error.observed_order},
                      {"used_order", error.used_order},
                      {"safety_factor", error.safety_factor},
                      {"bar_distance_mm", error.bar_distance},
                      {"share_near_bars", error.share_near_bars},
                      {"mean_mm", numbers(error.mean)},
                      {"max_mm", numbers(error.max)},
                      {"max_near_bars_mm", numbers(error.max_near_bars)},
                      {"mean_by_organ_mm", by_organ(error.mean_by_organ)},
                      {"max_by_organ_mm", by_organ(error.max_by_organ)}};
  return study.dump(2) + "\n";
}

DiscretisationError read_mesh_study(const std::string &text)
{
  try
  {
    const json study = json::parse(text);
    DiscretisationError error;
    error.case_sha256 = study.at("case_sha256").get<std::string>();
    error.solver_sha256 = study.at("solver_sha256").get<std::string>();
    error.revision = study.at("revision").get<std::string>();
    error.cell_sizes = vector_from(study.at("cell_sizes_mm"));
    const auto n_cells = study.at("n_cells").get<std::vector<int>>();
    error.n_cells = Eigen::Map<const Eigen::VectorXi>(n_cells.data(), static_cast<Eigen::Index>(n_cells.size()));
    error.observed_order = study.at("observed_order").get<double>();
    error.used_order = study.at("used_order").get<double>();
    error.safety_factor = study.at("safety_factor").get<double>();
    error.bar_distance = study.at("bar_distance_mm").get<double>();
    error.share_near_bars = study.at("share_near_bars").get<double>();
    error.mean = vector_from(study.at("mean_mm"));
    error.max = vector_from(study.at("max_mm"));
    error.max_near_bars = vector_from(study.at("max_near_bars_mm"));
    error.mean_by_organ = by_organ_from(study.at("mean_by_organ_mm"));
    error.max_by_organ = by_organ_from(study.at("max_by_organ_mm"));
    return error;
  }
  catch (const nlohmann::json::exception &problem)
  {
    throw InputError(std::string("a mesh study cannot be read: ") + problem.what() +
                     "; run 'pelvireg mesh-study' again");
  }
}

std::string case_digest(const std::string &text, const std::string &case_name)
{
  return sha256_of_text(anatomy::reference_text(text, case_name));
}

std::string solver_digest()
{
  return sha256_of_text(source_digest("reference_fe") + source_digest("synthetic/anatomy"));
}

std::optional<DiscretisationError> known_discretisation_error(const std::string &text, const std::string &case_name)
{
  for (const std::string &study : built_in_mesh_studies())
  {
    DiscretisationError error = read_mesh_study(study);
    error.same_solver = error.solver_sha256 == solver_digest();
    if (error.case_sha256 == case_digest(text, case_name))
      return error;
  }
  return {};
}
} // namespace pelvireg::cli
