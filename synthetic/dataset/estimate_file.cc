#include "synthetic/dataset/estimate_file.h"

#include "synthetic/dataset/error.h"
#include "synthetic/dataset/estimate_steps.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <utility>

namespace pelvireg::dataset
{
namespace
{
constexpr const char *whole_format = "pelvireg estimate";
constexpr const char *part_format = "pelvireg estimate part";

std::string sample_group(std::int32_t sample)
{
  char name[16];
  std::snprintf(name, sizeof name, "%04d", sample);
  return name;
}

void write_perturbation(GroupWriter group, const Perturbation &perturbation)
{
  group.text("kind", perturbation.kind);
  group.text("seed", std::to_string(perturbation.seed));
  group.number("modulus_spread", perturbation.modulus_spread);
  group.number("surface_sd_mm", perturbation.surface_sd);
  group.number("surface_correlation_length_mm", perturbation.surface_correlation_length);
  group.number("outline_sd_mm", perturbation.outline_sd);
  group.number("plane_offset_sd_mm", perturbation.plane_offset_sd);
  group.number("plane_tilt_sd_rad", perturbation.plane_tilt_sd);
}

Perturbation read_perturbation(const GroupReader &group)
{
  Perturbation perturbation;
  perturbation.kind = group.text("kind");
  const std::string seed = group.text("seed");
  const auto [end, error] = std::from_chars(seed.data(), seed.data() + seed.size(), perturbation.seed);
  if (error != std::errc() || end != seed.data() + seed.size())
    group.refuse("seed", "is '" + seed + "', must be a whole number from 0 to 2^64 - 1");
  perturbation.modulus_spread = group.number("modulus_spread");
  perturbation.surface_sd = group.number("surface_sd_mm");
  perturbation.surface_correlation_length = group.number("surface_correlation_length_mm");
  perturbation.outline_sd = group.number("outline_sd_mm");
  perturbation.plane_offset_sd = group.number("plane_offset_sd_mm");
  perturbation.plane_tilt_sd = group.number("plane_tilt_sd_rad");
  return perturbation;
}

void write_times(GroupWriter &group, const StepTimes &times)
{
  group.numbers("nominal_step_ms", times.step_ms);
  GroupWriter phases = group.group("nominal_phase_ms");
  phases.texts("names", times.phases);
  for (std::size_t k = 0; k < times.phases.size(); ++k)
    phases.numbers(times.phases[k], times.phase_ms[k]);
}

StepTimes read_times(const GroupReader &group)
{
  const auto step_ms = group.array<Eigen::VectorXd>("nominal_step_ms");
  const GroupReader phases = group.group("nominal_phase_ms");
  StepTimes times{{step_ms.begin(), step_ms.end()}, phases.texts("names"), {}};
  for (const std::string &name : times.phases)
    times.phase_ms.push_back(phases.numbers(name, step_ms.size()));
  return times;
}

void write_part(GroupWriter group, const EstimatePart &part)
{
  group.integer("samples", part.samples);
  group.integer("shard", part.shard);
  group.integer("n_shards", part.n_shards);
  group.text("anatomy_sha256", part.anatomy_sha256);
  group.text("observations_sha256", part.observations_sha256);
  group.text("program_sha256", part.program_sha256);
  write_times(group, part.nominal_times);
}

EstimatePart read_part(const GroupReader &group)
{
  return {.samples = group.integer("samples"),
          .shard = group.integer("shard"),
          .n_shards = group.integer("n_shards"),
          .anatomy_sha256 = group.text("anatomy_sha256"),
          .observations_sha256 = group.text("observations_sha256"),
          .program_sha256 = group.text("program_sha256"),
          .nominal_times = read_times(group)};
}

void write_rest_surfaces(GroupWriter group, const std::vector<EstimateSurface> &surfaces)
{
  std::vector<std::string> names;
  for (const EstimateSurface &surface : surfaces)
  {
    names.push_back(surface.name);
    GroupWriter entry = group.group(surface.name);
    write_surface(entry, surface.rest);
  }
  group.texts("names", names);
}

std::vector<EstimateSurface> read_rest_surfaces(const GroupReader &group)
{
  std::vector<EstimateSurface> surfaces;
  for (const std::string &name : group.texts("names"))
    surfaces.push_back({name, read_surface(group.group(name)), {}});
  return surfaces;
}

void write_contact_pairs(GroupWriter group, const Estimate &estimate)
{
  std::vector<std::string> first, second;
  for (const auto &[a, b] : estimate.contact_pairs)
  {
    first.push_back(a);
    second.push_back(b);
  }
  group.texts("organ_a", first);
  group.texts("organ_b", second);
}

std::vector<std::pair<std::string, std::string>> read_contact_pairs(const GroupReader &group)
{
  const std::vector<std::string> first = group.texts("organ_a"), second = group.texts("organ_b");
  if (first.size() != second.size())
    group.refuse("organ_b",
                 "has " + std::to_string(second.size()) + " names, organ_a has " + std::to_string(first.size()));
  std::vector<std::pair<std::string, std::string>> pairs;
  for (std::size_t i = 0; i < first.size(); ++i)
    pairs.emplace_back(first[i], second[i]);
  return pairs;
}

/// may_move: the perturbation moves the rest surfaces themselves.
void require_fits(const EstimateSample &sample, const std::vector<EstimateSurface> &rest_surfaces, bool may_move)
{
  bool fits = sample.surfaces.size() == rest_surfaces.size();
  for (std::size_t i = 0; fits && i < rest_surfaces.size(); ++i)
  {
    const EstimateSurface &own = sample.surfaces[i], &common = rest_surfaces[i];
    fits = own.name == common.name && own.rest.points.rows() == common.rest.points.rows() &&
           (may_move || own.rest.points == common.rest.points) && own.rest.triangles == common.rest.triangles &&
           own.rest.region == common.rest.region && own.positions.size() == sample.steps.size();
  }
  if (!fits)
    throw ComputationError("cannot store sample " + std::to_string(sample.sample) +
                           ": it has another rest surface than the nominal run, or not one position a step");
}

/// Only where the perturbation moved the rest surface itself.
void write_own_rest(GroupWriter &group, const EstimateSample &sample, const std::vector<EstimateSurface> &rest_surfaces)
{
  std::optional<GroupWriter> rest;
  for (std::size_t i = 0; i < rest_surfaces.size(); ++i)
    if (sample.surfaces[i].rest.points != rest_surfaces[i].rest.points)
    {
      if (!rest)
        rest.emplace(group.group("rest"));
      rest->array(sample.surfaces[i].name, sample.surfaces[i].rest.points);
    }
}

void write_bodies(GroupWriter group, const std::vector<BodyNodes> &bodies)
{
  std::vector<std::string> names;
  for (const BodyNodes &body : bodies)
  {
    names.push_back(body.name);
    GroupWriter entry = group.group(body.name);
    entry.array("rest", body.rest);
    entry.array("last", body.last);
  }
  group.texts("names", names);
}

std::vector<BodyNodes> read_bodies(const GroupReader &group)
{
  std::vector<BodyNodes> bodies;
  for (const std::string &name : group.texts("names"))
  {
    const GroupReader entry = group.group(name);
    const auto rest = entry.array<Points>("rest");
    bodies.push_back({name, rest, entry.array<Points>("last", rest.rows())});
  }
  return bodies;
}

/// Of a file without the group, written before there was one, only the moduli can have been drawn.
Perturbation perturbation_of(const GroupReader &root)
{
  return root.has("perturbation") ? read_perturbation(root.group("perturbation")) : Perturbation{};
}
} // namespace

EstimateWriter::EstimateWriter(const std::filesystem::path &file, const Estimate &description,
                               const std::vector<EstimateSurface> &rest_surfaces, const EstimatePart *part)
    : file_(file, part ? part_format : whole_format), rest_surfaces_(rest_surfaces),
      n_pairs_(description.contact_pairs.size()), moves_surfaces_(description.perturbation.kind == "surface")
{
  GroupWriter &root = file_.root();
  root.text("case_name", description.case_name);
  root.text("condition", description.condition);
  write_perturbation(root.group("perturbation"), description.perturbation);
  if (part)
    write_part(root.group("part"), *part);
  write_rest_surfaces(root.group("surfaces"), rest_surfaces);
  write_contact_pairs(root.group("contact_pairs"), description);
  samples_.emplace(root.group("samples"));
}

void EstimateWriter::add(const EstimateSample &sample)
{
  if (!numbers_.empty() && sample.sample <= numbers_.back())
    throw ComputationError("cannot store sample " + std::to_string(sample.sample) + " after sample " +
                           std::to_string(numbers_.back()) + ": samples must ascend");
  require_fits(sample, rest_surfaces_, moves_surfaces_);
  GroupWriter group = samples_->group(sample_group(sample.sample));
  write_steps(group.group("steps"), sample.steps, n_pairs_);
  write_own_rest(group, sample, rest_surfaces_);
  GroupWriter positions = group.group("positions");
  for (const EstimateSurface &surface : sample.surfaces)
    positions.stack(surface.name, surface.positions);
  if (!sample.bodies.empty())
    write_bodies(group.group("bodies"), sample.bodies);
  numbers_.push_back(sample.sample);
}

void EstimateWriter::finish()
{
  samples_->integers("numbers", numbers_);
  samples_.reset(); // the file closes only when every group is closed
  file_.finish();
}

EstimateReader::EstimateReader(const std::filesystem::path &file, Kind kind)
    : file_(file, kind == Kind::part ? part_format : whole_format)
{
  const GroupReader &root = file_.root();
  description_.case_name = root.text("case_name");
  description_.condition = root.text("condition");
  description_.perturbation = perturbation_of(root);
  if (kind == Kind::part)
    part_ = read_part(root.group("part"));
  rest_surfaces_ = read_rest_surfaces(root.group("surfaces"));
  description_.contact_pairs = read_contact_pairs(root.group("contact_pairs"));
  const GroupReader samples = root.group("samples");
  const auto numbers = samples.array<Integers>("numbers");
  numbers_.assign(numbers.begin(), numbers.end());
  if (std::adjacent_find(numbers_.begin(), numbers_.end(), std::greater_equal<>()) != numbers_.end())
    samples.refuse("numbers", "does not ascend");
}

EstimateSample EstimateReader::sample(std::int32_t number) const
{
  const GroupReader group = file_.root().group("samples").group(sample_group(number));
  EstimateSample sample;
  sample.sample = number;
  sample.steps = read_steps(group.group("steps"), description_.contact_pairs.size());
  sample.surfaces = rest_surfaces_;
  if (group.has("rest"))
  {
    const GroupReader rest = group.group("rest");
    for (EstimateSurface &surface : sample.surfaces)
      if (rest.has(surface.name))
        surface.rest.points = rest.array<Points>(surface.name, surface.rest.points.rows());
  }
  const GroupReader positions = group.group("positions");
  for (EstimateSurface &surface : sample.surfaces)
    surface.positions =
        positions.stack(surface.name, static_cast<std::int64_t>(sample.steps.size()), surface.rest.points.rows());
  if (group.has("bodies"))
    sample.bodies = read_bodies(group.group("bodies"));
  return sample;
}
} // namespace pelvireg::dataset
