// Frames a second of every tracker: four organs, 256 x 256 pixels, one core.
#include "tests/unit/tracking/moving_scene.h"

#include <benchmark/benchmark.h>

namespace pelvireg::tracking
{
namespace
{
/// Twice the size of the unit tests' scene: organs have as many pixels as in images of 1.5 mm.
Scene large_scene()
{
  Scene scene = four_organs();
  scene.size = 256;
  scene.noise = 0.05;
  for (EllipticOrgan &organ : scene.organs)
    organ.centre += Eigen::Vector2d(64, 64);
  scene.displacement = [](const Eigen::Vector2d &x)
  {
    const Eigen::Vector2d q = x - Eigen::Vector2d(128, 128);
    return Eigen::Vector2d(7 - 0.2 * q.y(), 9 + 0.2 * q.x());
  };
  return scene;
}

void track(benchmark::State &state, const std::string &name)
{
  constexpr int n_frames = 20;
  const Scene scene = large_scene();
  std::vector<Image> frames;
  for (int i = 0; i <= n_frames; ++i)
    frames.push_back(scene.image(static_cast<double>(i) / n_frames, static_cast<unsigned>(i) + 1));
  const auto tracker = make_tracker(name);
  for (auto _ : state)
  {
    state.PauseTiming();
    tracker->start(frames[0], scene.initial_outlines());
    state.ResumeTiming();
    for (int i = 1; i <= n_frames; ++i)
      benchmark::DoNotOptimize(tracker->update(frames[static_cast<std::size_t>(i)]));
  }
  state.counters["frames_per_s"] =
      benchmark::Counter(static_cast<double>(n_frames * state.iterations()), benchmark::Counter::kIsRate);
}
} // namespace
} // namespace pelvireg::tracking

int main(int argc, char **argv)
{
  for (const std::string &name : pelvireg::tracking::tracker_names())
    benchmark::RegisterBenchmark(("track/" + name).c_str(), pelvireg::tracking::track, name)
        ->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
    return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
