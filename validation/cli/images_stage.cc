#include "validation/cli/images_stage.h"

#include "synthetic/dataset/error.h"
#include "synthetic/observation/images/image_files.h"
#include "validation/cli/commands.h"

#include <fmt/format.h>

#include <memory>

namespace pelvireg::cli
{
namespace
{
struct Arguments
{
  std::string directory;
  observation::ImageOptions options;
};

std::string text_of(const observation::ImageOptions &options)
{
  return fmt::format("matrix {} pixel {} thickness {} snr {} static snr {} rate {} frames {} segments {} seed {}",
                     options.matrix, options.pixel, options.slice_thickness, options.snr, options.static_snr,
                     options.frame_rate, options.frames_per_increment, options.segments, options.seed);
}

Notes work(const std::filesystem::path &directory, const observation::ImageOptions &options)
{
  const dataset::Anatomy anatomy = dataset::load_anatomy(directory / "anatomy.h5");
  const dataset::Truth truth = dataset::load_truth(directory / "truth.h5");
  const observation::Images images = observation::make_images(anatomy, truth, options);
  const std::filesystem::path folder = directory / "images";
  std::filesystem::create_directories(folder);
  observation::write_nrrd(images.dyn, folder / "dyn.nrrd");
  observation::write_nrrd(images.tse, folder / "tse.nrrd");
  observation::write_nrrd(images.ffe, folder / "ffe.nrrd");
  observation::write_dicom(images.dyn, truth.case_name, folder / "dyn");
  observation::write_dicom(images.tse, truth.case_name, folder / "tse");
  observation::write_dicom(images.ffe, truth.case_name, folder / "ffe");
  return {{"snr", options.snr}, {"frames", static_cast<double>(images.dyn.times_s.size())}};
}
} // namespace

void make_image_files(ResultDirectory &directory, observation::ImageOptions options)
{
  if (const auto violations = options.violations(); !violations.empty())
    throw InputError(violations.front());
  directory.run({.name = "images",
                 .code = {"synthetic/observation", "synthetic/observation/images", "synthetic/dataset"},
                 .options = text_of(options),
                 .inputs = {"anatomy.h5", "truth.h5"},
                 .outputs = {"images/dyn.nrrd", "images/tse.nrrd", "images/ffe.nrrd"},
                 .work = [&](Progress &progress)
                 {
                   options.progress = progress.callback();
                   return work(directory.path(), options);
                 }});
}

void add_images_command(CLI::App &program, Invocation &invocation)
{
  const auto arguments = std::make_shared<Arguments>();
  observation::ImageOptions &options = arguments->options;
  CLI::App *command = program.add_subcommand(
      "images", "MR images of the truth: dynamic series, TSE volume, FFE slices, as NRRD and DICOM in DIR/images");
  command->add_option("DIR", arguments->directory, "Result directory")->required();
  command->add_option("--snr", options.snr, "Urine's signal over the noise in the dynamic images; 0: no noise")
      ->capture_default_str();
  command->add_option("--static-snr", options.static_snr, "The same in TSE and FFE")->capture_default_str();
  command->add_option("--frame-rate", options.frame_rate, "Frames a second")->capture_default_str();
  command->add_option("--frames-per-increment", options.frames_per_increment, "Frames from one increment to the next")
      ->capture_default_str();
  command->add_option("--matrix", options.matrix, "Pixels each way")->capture_default_str();
  command->add_option("--pixel", options.pixel, "Pixel spacing of the dynamic images and FFE slices, mm")
      ->capture_default_str();
  command->add_option("--slice-thickness", options.slice_thickness, "Of the dynamic images, mm")->capture_default_str();
  command->add_option("--segments", options.segments, "Instants that share one frame's lines; 1: still within a frame")
      ->capture_default_str();
  command->add_option("--seed", options.seed, "Seed of the noise")->capture_default_str();
  add_jobs_option(*command, options.n_threads);
  command->footer("Examples:\n  pelvireg images out/t005\n  pelvireg images out/t005 --snr 10 --jobs 2");
  command->callback(
      [&invocation, arguments]
      {
        invocation.action = [&invocation, arguments]
        {
          ResultDirectory directory(arguments->directory, invocation.command_line, ResultDirectory::Missing::refuse);
          make_image_files(directory, arguments->options);
        };
      });
}
} // namespace pelvireg::cli
