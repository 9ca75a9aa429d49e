// Speed of one registration step: whole, by phase, by size, by threads, and against the usual way. See
// docs/benchmark.md. Not a test: times depend on the machine.
#include "registration/constraints/attachment.h"
#include "registration/constraints/sliding.h"
#include "registration/solver/body_solver.h"
#include "tests/benchmark/step_scene.h"
#include "tests/benchmark/table1_scene.h"
#include "tests/benchmark/usual_way.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <functional>
#include <sys/resource.h>
#include <unistd.h>

namespace pelvireg::bench
{
namespace
{
using namespace registration;

using Play = std::vector<Observation>;

double quantile(std::vector<double> values, double share)
{
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

double median(const std::vector<double> &values)
{
  return quantile(values, 0.5);
}

double milliseconds_of(const std::function<void()> &work)
{
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// One step; its wall time in ms. Anything but a step that succeeded ends the program: its time would mean nothing.
double timed_step(Registration &registration, const Observation &observation, StepSummary &summary)
{
  const double time = milliseconds_of([&] { summary = registration.update(observation); });
  if (summary.status == StepStatus::ok)
    return time;
  std::fprintf(stderr, "registration_bench: a step failed: %s\n", to_string(summary.status).c_str());
  std::exit(1);
}

/// Contact constraints of a step, in a registration that knows contact.
template <class Summary> int n_contacts(const Summary &summary)
{
  if constexpr (requires { summary.n_contacts; })
    return summary.n_contacts;
  else
    return 0;
}

/// Medians over the steps since construction, ms.
class PhaseMedians
{
public:
  void add(const PhaseTimes &t, double step)
  {
    for (std::size_t k = 0; k < step_phases.size(); ++k)
      phases_[k].push_back(t.*step_phases[k].time);
    steps_.push_back(step);
  }
  void report(::benchmark::State &state) const
  {
    for (std::size_t k = 0; k < step_phases.size(); ++k)
      state.counters[std::string(step_phases[k].name) + "_ms"] = median(phases_[k]);
    state.counters["step_ms"] = median(steps_);
    state.counters["steps_per_s"] = 1000 / median(steps_);
    state.counters["step_p05_ms"] = quantile(steps_, 0.05);
    state.counters["step_p95_ms"] = quantile(steps_, 0.95);
  }

private:
  std::array<std::vector<double>, step_phases.size()> phases_;
  std::vector<double> steps_;
};

void report_size(::benchmark::State &state, const Registration &registration, const StepSummary &summary)
{
  const SystemSize size = registration.system_size();
  state.counters["unknowns"] = size.n_unknowns;
  state.counters["factor_values"] = static_cast<double>(size.n_factor_values);
  state.counters["outline_rows"] = summary.accepted_control_points;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_rss_MB"] = static_cast<double>(usage.ru_maxrss) / 1024; // of the program so far
}

/// Steps through the play over and over; the first `n_warm_up` steps are not counted.
void run_steps(::benchmark::State &state, const Model &model, const Options &options, const Play &play, int n_warm_up)
{
  Registration registration;
  registration.prepare(model, options);
  StepSummary summary;
  std::size_t next = 0;
  const auto observation = [&]() -> const Observation & { return play[next++ % play.size()]; };
  for (int step = 0; step < n_warm_up; ++step)
    timed_step(registration, observation(), summary);
  PhaseMedians phases;
  std::vector<double> contacts, sweeps;
  for (auto _ : state)
  {
    const double time = timed_step(registration, observation(), summary);
    state.SetIterationTime(time / 1000);
    contacts.push_back(n_contacts(summary));
    sweeps.push_back(summary.sweeps);
    phases.add(registration.phase_times(), time);
  }
  phases.report(state);
  state.counters["contacts"] = median(contacts);
  state.counters["sweeps"] = median(sweeps);
  report_size(state, registration, summary);
}

/// Cells of 2 mm: the made-up organs touch in spots of about a square centimetre, and 30 contacts are wanted.
template <class AnyOptions> void refine_contact(AnyOptions &options)
{
  if constexpr (requires { options.contact_cell; })
    options.contact_cell = 2;
}

void table1_step(::benchmark::State &state, const std::string &data_set, double scale)
{
  const Scene scene = table1_scene(table1_counts(data_set), scale);
  Options options;
  refine_contact(options);
  options.n_threads = static_cast<int>(state.range(0));
  run_steps(state, scene.model, options, scene.observations, 20);
}

void step_scene(::benchmark::State &state, const std::string &folder)
{
  Options options = step_scene_options();
  options.n_threads = static_cast<int>(state.range(0));
  run_steps(state, read_step_scene(folder), options, {Observation()}, 20);
}

/// T005 from its scalar reading to ten times as many unknowns, the sizes taking turns so that all see the same machine;
/// the exponent is the slope of log time over log unknowns.
void growth(::benchmark::State &state)
{
  const std::vector<double> factors = {1, 2, 3, 5, 10};
  std::vector<Scene> scenes;
  std::vector<Registration> registrations(factors.size());
  std::vector<std::vector<double>> times(factors.size());
  for (std::size_t k = 0; k < factors.size(); ++k)
  {
    scenes.push_back(table1_scene(table1_counts("T005"), factors[k] / 3));
    Options options;
    refine_contact(options);
    options.n_threads = static_cast<int>(state.range(0));
    registrations[k].prepare(scenes[k].model, options);
  }
  StepSummary summary;
  std::size_t next = 0;
  for (auto _ : state)
  {
    for (std::size_t k = 0; k < factors.size(); ++k)
      times[k].push_back(
          timed_step(registrations[k], scenes[k].observations[next % scenes[k].observations.size()], summary));
    ++next;
  }
  double n = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
  for (std::size_t k = 0; k < factors.size(); ++k)
  {
    const int n_unknowns = registrations[k].system_size().n_unknowns;
    const double x = std::log(n_unknowns), y = std::log(median(times[k]));
    ++n, sum_x += x, sum_y += y, sum_xx += x * x, sum_xy += x * y;
    state.counters["ms_at_" + std::to_string(n_unknowns)] = median(times[k]);
  }
  state.counters["exponent"] = (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
}

/// The rows of one step at the registration's present positions: sliding and attachments.
ConstraintRows rows_at(const Model &model, const Options &options, const Registration &registration,
                       const Observation &observation)
{
  ConstraintRows rows;
  std::vector<TriangleTree> trees;
  for (std::size_t body = 0; body < model.bodies.size(); ++body)
    trees.emplace_back(model.bodies[body].outer_triangles, model.bodies[body].rest_positions);
  std::vector<AttachedNode> attached;
  for (const Attachment &attachment : model.attachments)
    for (const AttachedNode &node : bind_attachment(attachment, model.bodies, trees[attachment.body_b], 0))
      add_attachment_rows(node, registration.positions(node.body_a), registration.positions(node.body_b), rows);
  for (const OutlineObservation &outline : observation.outlines)
  {
    const Points &positions = registration.positions(outline.body);
    trees[outline.body].refit(positions);
    for (Eigen::Index k = 0; k < outline.points.rows(); ++k)
      if (const SlidingMatch match = match_control_point(trees[outline.body], positions, outline.points.row(k),
                                                         outline.normals.row(k), observation.plane_normal, options);
          match.is_accepted)
        add_sliding_row(match, outline.body, options.sliding_compliance, rows);
  }
  return rows;
}

/// What both ways need of one body: they work on the same matrix and the same rows, one after the other.
struct PairedBody
{
  PairedBody(const Body &body, double time_step) : ours(body, time_step), usual(ours) {}
  BodySolver ours;
  UsualWay usual;
};

struct PairedTimes
{
  double ours = 0, usual = 0; ///< ms
  double difference_of_w = 0; ///< largest, relative to W's largest entry
};

PairedTimes compare_body(PairedBody &body, const Points &positions, const ConstraintRows &rows, int index)
{
  body.ours.set_positions(positions);
  body.ours.assemble();
  body.ours.gather_rows(rows, index);
  body.usual.take(body.ours, rows, index);
  const Eigen::VectorXd multipliers = Eigen::VectorXd::Constant(rows.size(), 0.1);
  const Eigen::VectorXd own =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(body.ours.touching_rows().size()), 0.1);
  PairedTimes times;
  times.ours = milliseconds_of(
      [&]
      {
        body.ours.factorise();
        body.ours.predict_free_motion();
        body.ours.gather_rows(rows, index);
        body.ours.compute_compliance();
        body.ours.correct(multipliers);
      });
  times.usual = milliseconds_of(
      [&]
      {
        body.usual.factorise();
        body.usual.predict_free_motion();
        body.usual.compute_compliance();
        body.usual.correct(own);
      });
  const Eigen::MatrixXd difference = (body.ours.compliance() - body.usual.compliance()).triangularView<Eigen::Lower>();
  if (own.size() > 0)
    times.difference_of_w = difference.cwiseAbs().maxCoeff() / body.usual.compliance().cwiseAbs().maxCoeff();
  return times;
}

/// One thread. The step's other phases are the same code either way, so their time is added to both.
void against_usual_way(::benchmark::State &state, const std::string &data_set, double scale)
{
  const Scene scene = table1_scene(table1_counts(data_set), scale);
  const Options options;
  Registration registration;
  registration.prepare(scene.model, options);
  std::deque<PairedBody> bodies; // Eigen's factor cannot move
  for (const Body &body : scene.model.bodies)
    bodies.emplace_back(body, options.time_step);
  std::vector<double> ours, usual, ours_step, usual_step;
  double difference = 0;
  std::size_t next = 0;
  StepSummary summary;
  for (auto _ : state)
  {
    const Observation &observation = scene.observations[next++ % scene.observations.size()];
    const ConstraintRows rows = rows_at(scene.model, options, registration, observation);
    PairedTimes sum;
    for (std::size_t body = 0; body < bodies.size(); ++body)
    {
      const int index = static_cast<int>(body);
      const PairedTimes times = compare_body(bodies[body], registration.positions(index), rows, index);
      sum.ours += times.ours;
      sum.usual += times.usual;
      difference = std::max(difference, times.difference_of_w);
    }
    const double step = timed_step(registration, observation, summary);
    const PhaseTimes &t = registration.phase_times();
    const double common = step - t.factorise - t.free_motion - t.compliance - t.correct;
    ours.push_back(sum.ours);
    usual.push_back(sum.usual);
    ours_step.push_back(sum.ours + common);
    usual_step.push_back(sum.usual + common);
  }
  state.counters["algebra_ms"] = median(ours);
  state.counters["usual_algebra_ms"] = median(usual);
  state.counters["algebra_ratio"] = median(usual) / median(ours);
  state.counters["step_ratio"] = median(usual_step) / median(ours_step);
  state.counters["difference_of_W"] = difference;
}

void add_benchmarks(const std::vector<std::string> &step_scenes)
{
  using ::benchmark::RegisterBenchmark;
  constexpr double as_scalars = 1.0 / 3, as_nodes = 1;
  constexpr int n_steps = 200;
  const auto add = [](const std::string &name, auto function, int n_iterations, const std::vector<int> &threads)
  {
    ::benchmark::internal::Benchmark *added = RegisterBenchmark(name.c_str(), function);
    added->Unit(::benchmark::kMillisecond)->Iterations(n_iterations)->ArgName("threads")->MeasureProcessCPUTime();
    for (const int n : threads)
      added->Arg(n);
    return added;
  };
  for (const std::string data_set : {"T005", "T007"})
    for (const auto &[reading, scale] : {std::pair("scalars", as_scalars), std::pair("nodes", as_nodes)})
    {
      const double s = scale;
      const auto step = [data_set, s](::benchmark::State &state) { table1_step(state, data_set, s); };
      add("step/" + data_set + "_" + reading, step, n_steps, {1, 2})->UseManualTime();
    }
  for (const std::string &folder : step_scenes)
  {
    const std::string name = folder.substr(folder.find_last_of('/') + 1);
    add("step_scene/" + name, [folder](::benchmark::State &state) { step_scene(state, folder); }, n_steps, {1, 2})
        ->UseManualTime();
  }
  add("growth/T005", growth, 45, {1, 2});
  for (const std::string data_set : {"T005", "T007"})
    for (const auto &[reading, scale] : {std::pair("scalars", as_scalars), std::pair("nodes", as_nodes)})
    {
      const double s = scale;
      const auto compare = [data_set, s](::benchmark::State &state) { against_usual_way(state, data_set, s); };
      add("against_usual_way/" + data_set + "_" + reading, compare, 20, {1});
    }
}

/// Libraries read these before main() starts, so the program starts itself again when they are not set.
void ensure_single_threaded_libraries(char **argv)
{
  if (std::getenv("OMP_THREAD_LIMIT") && std::getenv("OPENBLAS_NUM_THREADS"))
    return;
  constexpr int keep_what_is_set = 0;
  ::setenv("OMP_THREAD_LIMIT", "1", keep_what_is_set);
  ::setenv("OPENBLAS_NUM_THREADS", "1", keep_what_is_set);
  ::execv("/proc/self/exe", argv);
}

/// Takes every --step_scene=FOLDER out of the arguments.
std::vector<std::string> take_step_scenes(int &argc, char **argv)
{
  constexpr const char *option = "--step_scene=";
  std::vector<std::string> folders;
  int kept = 0;
  for (int k = 0; k < argc; ++k)
    if (std::strncmp(argv[k], option, std::strlen(option)) == 0)
    {
      std::string folder = argv[k] + std::strlen(option);
      while (folder.size() > 1 && folder.back() == '/')
        folder.pop_back();
      read_step_scene(folder); // a wrong path is said before anything is measured
      folders.push_back(folder);
    }
    else
      argv[kept++] = argv[k];
  argv[kept] = nullptr;
  argc = kept;
  return folders;
}
} // namespace
} // namespace pelvireg::bench

int main(int argc, char **argv)
{
  using namespace pelvireg;
  bench::ensure_single_threaded_libraries(argv);
  try
  {
    bench::add_benchmarks(bench::take_step_scenes(argc, argv));
    ::benchmark::AddCustomContext("kernels", registration::kernels::best().instruction_set);
    ::benchmark::Initialize(&argc, argv);
    if (::benchmark::ReportUnrecognizedArguments(argc, argv))
      return 2;
    ::benchmark::RunSpecifiedBenchmarks();
  }
  catch (const std::exception &error)
  {
    std::fprintf(stderr, "registration_bench: %s\n", error.what());
    return 2;
  }
}
