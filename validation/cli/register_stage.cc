#include "validation/cli/register_stage.h"

#include "synthetic/dataset/error.h"
#include "synthetic/dataset/estimate_file.h"
#include "validation/cli/sha256.h"
#include "validation/cli/timing_notes.h"
#include "validation/cli/version.h"
#include "validation/runner/merge.h"
#include "validation/runner/part_store.h"
#include "validation/runner/perturbation.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>

namespace pelvireg::cli
{
namespace
{
const std::vector<std::string> code = {"registration", "validation/runner", "synthetic/dataset"};

/// What drives the registration.
std::string outline_file(const dataset::Perturbation &perturbation)
{
  return perturbation.kind == dataset::tracked_outlines ? "tracked.h5" : "observations.h5";
}

std::string label_of(const RegisterRequest &request)
{
  dataset::Estimate estimate;
  estimate.condition = request.condition;
  estimate.perturbation = request.perturbation;
  return estimate.label();
}

std::string text_of(const dataset::Perturbation &perturbation)
{
  return fmt::format("{} seed {} spread {} surface {} {} outline {} plane {} {}", perturbation.kind, perturbation.seed,
                     perturbation.modulus_spread, perturbation.surface_sd, perturbation.surface_correlation_length,
                     perturbation.outline_sd, perturbation.plane_offset_sd, perturbation.plane_tilt_sd);
}

dataset::EstimatePart origin_of(ResultDirectory &directory, const dataset::Perturbation &perturbation, int samples,
                                const runner::Shard &shard)
{
  const FileDigests digests = directory.current({"anatomy.h5", outline_file(perturbation)});
  std::string program = build() + "\n";
  for (const std::string &folder : code)
    program += folder + " " + source_digest(folder) + "\n";
  return {.samples = samples,
          .shard = shard.index,
          .n_shards = shard.n,
          .anatomy_sha256 = digests.at("anatomy.h5"),
          .observations_sha256 = digests.at(outline_file(perturbation)),
          .program_sha256 = sha256_of_text(program),
          .nominal_times = {}};
}

std::filesystem::path parts_folder(const ResultDirectory &directory, const std::string &label)
{
  return directory.path() / ("parts-" + label);
}

runner::PartStore store_of(const ResultDirectory &directory, const runner::RegistrationRuns &runs,
                           const dataset::EstimatePart &origin)
{
  return {parts_folder(directory, runs.description().label()), runs.description(), runs.rest_surfaces(), origin};
}

runner::RegistrationRuns runs_of(const ResultDirectory &directory, const RegisterRequest &request)
{
  return {dataset::load_anatomy(directory.path() / "anatomy.h5"),
          dataset::load_observations(directory.path() / outline_file(request.perturbation)), request.condition,
          request.perturbation};
}

/// Play what the store does not hold yet. Bad input leaves nothing behind, a kill or a full disk leaves what is done.
void fill(const runner::PartStore &store, const runner::RegistrationRuns &runs, const std::vector<int> &numbers,
          int jobs, Progress &progress)
{
  std::vector<int> missing;
  std::copy_if(numbers.begin(), numbers.end(), std::back_inserter(missing), [&](int run) { return !store.has(run); });
  if (missing.size() < numbers.size())
    progress.say(fmt::format("resumed, {} of {} runs are there", numbers.size() - missing.size(), numbers.size()));
  runner::RunnerOptions options;
  options.n_threads = jobs;
  options.progress = progress.callback();
  try
  {
    runner::play_runs(runs, missing, options,
                      [&](const dataset::EstimateSample &run, const dataset::StepTimes &times)
                      { store.save(run, times); });
  }
  catch (const InputError &)
  {
    store.remove(numbers);
    throw;
  }
}

Notes to_notes(const dataset::StepTimes &nominal_times)
{
  return nominal_times.step_ms.empty() ? Notes{} : notes_of(runner::timing_of("", nominal_times));
}

/// The same stage whether its runs are played here or come as shards: equal keys, equal bytes.
Stage stage_of(const RegisterRequest &request, std::function<Notes(Progress &)> work)
{
  const std::string label = label_of(request);
  return {.name = "register " + label,
          .code = code,
          .options = fmt::format("samples {} of {}", request.samples, text_of(request.perturbation)),
          .inputs = {"anatomy.h5", outline_file(request.perturbation)},
          .outputs = {"estimate-" + label + ".h5"},
          .work = std::move(work)};
}

bool is_done(const std::filesystem::path &shard, const RegisterRequest &request, const dataset::EstimatePart &origin)
{
  if (!std::filesystem::exists(shard))
    return false;
  try
  {
    const dataset::EstimateReader reader(shard, dataset::EstimateReader::Kind::part);
    dataset::Estimate description = reader.description();
    description.condition = request.condition;
    description.perturbation = request.perturbation;
    return runner::is_from(reader, description, origin) && reader.part().samples == origin.samples &&
           reader.part().shard == origin.shard && reader.part().n_shards == origin.n_shards;
  }
  catch (const InputError &)
  {
    return false; // damaged: made again
  }
}

std::vector<std::filesystem::path> shards_in(const std::filesystem::path &directory)
{
  std::vector<std::filesystem::path> files;
  for (const auto &entry : std::filesystem::directory_iterator(directory))
    if (entry.path().filename().string().rfind("shard-", 0) == 0 && entry.path().extension() == ".h5")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

void require_same_origin(const runner::ShardSet &shards, const dataset::EstimatePart &here,
                         const std::filesystem::path &directory)
{
  const auto require_same = [&](const std::string &got, const std::string &wanted, const std::string &what)
  {
    if (got != wanted)
      throw InputError(
          fmt::format("merge: '{}' was made from another {} than the one of '{}'; register the shards again",
                      shards.files.front().string(), what, directory.string()));
  };
  require_same(shards.origin.anatomy_sha256, here.anatomy_sha256, "anatomy.h5");
  require_same(shards.origin.observations_sha256, here.observations_sha256, "observations.h5");
  require_same(shards.origin.program_sha256, here.program_sha256, "program");
}
} // namespace

std::vector<dataset::Perturbation> SampleSettings::perturbations() const
{
  constexpr double radians_a_degree = std::numbers::pi / 180;
  std::map<std::string, dataset::Perturbation> known;
  for (const std::string &kind : runner::perturbation_kinds())
    known[kind] = {.kind = kind, .seed = seed};
  known["modulus"].modulus_spread = spread.value_or(0.10);
  known["surface"].surface_sd = surface_sd.value_or(1.0);
  known["surface"].surface_correlation_length = correlation_length.value_or(10.0);
  known["outline"].outline_sd = outline_sd.value_or(1.0);
  known["plane"].plane_offset_sd = plane_offset_sd.value_or(2.0);
  known["plane"].plane_tilt_sd = radians_a_degree * plane_tilt_sd_degrees.value_or(2.0);
  const auto require_kind = [&](bool is_given, const std::string &option, const std::string &kind)
  {
    if (is_given && std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
      throw InputError(fmt::format("{} was given, but {} is perturbed, not {}; add '--perturb {}' or leave it out",
                                   option, fmt::join(kinds, ", "), kind, kind));
  };
  require_kind(spread.has_value(), "--spread", "modulus");
  require_kind(surface_sd.has_value(), "--surface-sd", "surface");
  require_kind(correlation_length.has_value(), "--correlation-length", "surface");
  require_kind(outline_sd.has_value(), "--outline-sd", "outline");
  require_kind(plane_offset_sd.has_value(), "--plane-offset-sd", "plane");
  require_kind(plane_tilt_sd_degrees.has_value(), "--plane-tilt-sd", "plane");
  std::vector<dataset::Perturbation> chosen;
  for (const std::string &kind : kinds)
  {
    runner::require_usable(known.at(kind));
    if (kind != "modulus" && samples == 0)
      throw InputError(
          fmt::format("--perturb {} needs randomised runs, got --samples 0; give --samples 1 or more", kind));
    chosen.push_back(known.at(kind));
  }
  return chosen;
}

std::vector<RegisterRequest> tracked_requests_of(const std::vector<std::string> &conditions)
{
  std::vector<RegisterRequest> requests;
  for (const std::string &condition : conditions)
    requests.push_back({condition, {.kind = dataset::tracked_outlines}, 0});
  return requests;
}

std::vector<RegisterRequest> requests_of(const std::vector<std::string> &conditions, const SampleSettings &settings)
{
  std::vector<RegisterRequest> requests;
  for (const dataset::Perturbation &perturbation : settings.perturbations())
    for (const std::string &condition : conditions)
      requests.push_back({condition, perturbation, settings.samples});
  return requests;
}

void make_estimate(ResultDirectory &directory, const RegisterRequest &request, int jobs)
{
  const std::filesystem::path parts = parts_folder(directory, label_of(request));
  const auto work = [&](Progress &progress) -> Notes
  {
    const runner::RegistrationRuns runs = runs_of(directory, request);
    const std::vector<int> numbers = runner::runs_of_shard(request.samples, {});
    const runner::PartStore store =
        store_of(directory, runs, origin_of(directory, request.perturbation, request.samples, {}));
    fill(store, runs, numbers, jobs, progress);
    store.assemble(numbers, directory.path() / ("estimate-" + label_of(request) + ".h5"));
    return to_notes(store.nominal_times());
  };
  try
  {
    directory.run(stage_of(request, work));
  }
  catch (const InputError &)
  {
    if (std::filesystem::is_directory(parts) && std::filesystem::is_empty(parts))
      std::filesystem::remove(parts);
    throw;
  }
  std::filesystem::remove_all(parts); // now that the manifest knows the estimate
}

void make_shard(ResultDirectory &directory, const RegisterRequest &request, const runner::Shard &shard, int jobs)
{
  const std::string label = label_of(request);
  const std::filesystem::path file =
      directory.path() / fmt::format("shard-{}-{}-of-{}.h5", label, shard.index, shard.n);
  Progress progress(fmt::format("register {}, shard {}/{}", label, shard.index, shard.n));
  dataset::EstimatePart origin = origin_of(directory, request.perturbation, request.samples, shard);
  if (is_done(file, request, origin))
    return progress.say("up to date");
  const runner::RegistrationRuns runs = runs_of(directory, request);
  const std::vector<int> numbers = runner::runs_of_shard(request.samples, shard);
  const runner::PartStore store = store_of(directory, runs, origin);
  fill(store, runs, numbers, jobs, progress);
  if (shard.index == 1)
    origin.nominal_times = store.nominal_times();
  store.assemble(numbers, file, &origin);
  store.remove(numbers);
  progress.finish("done");
}

void merge_estimates(ResultDirectory &directory, std::vector<std::filesystem::path> files)
{
  if (files.empty())
    files = shards_in(directory.path());
  if (files.empty())
    throw InputError(fmt::format("merge: '{}' holds no shard; make them with 'pelvireg register DIR --shard i/n'",
                                 directory.path().string()));
  std::map<std::string, std::vector<std::filesystem::path>> by_label;
  for (const std::filesystem::path &file : files)
    by_label[dataset::EstimateReader(file, dataset::EstimateReader::Kind::part).description().label()].push_back(file);
  std::map<std::string, runner::ShardSet> sets;
  for (const auto &[label, shards] : by_label)
  {
    sets[label] = runner::read_shards(shards);
    require_same_origin(sets[label], origin_of(directory, sets[label].description.perturbation, 0, {}),
                        directory.path());
  }
  for (const auto &[label, shards] : sets)
  {
    const auto work = [&](Progress &) -> Notes
    {
      runner::merge_shards(shards, directory.path() / ("estimate-" + label + ".h5"));
      return to_notes(shards.origin.nominal_times);
    };
    directory.run(
        stage_of({shards.description.condition, shards.description.perturbation, shards.origin.samples}, work));
    std::filesystem::remove_all(parts_folder(directory, label));
  }
}

std::vector<std::string> estimate_labels()
{
  std::vector<std::string> labels;
  for (const std::string &kind : runner::estimate_kinds())
    for (const std::string &condition : runner::condition_names())
      labels.push_back(label_of({condition, {.kind = kind}, 0}));
  return labels;
}
} // namespace pelvireg::cli
