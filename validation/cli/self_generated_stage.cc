#include "validation/cli/self_generated_stage.h"

#include "synthetic/anatomy/case.h"
#include "synthetic/dataset/error.h"
#include "validation/cli/register_stage.h"
#include "validation/cli/sha256.h"
#include "validation/cli/stages.h"
#include "validation/runner/self_generated.h"

#include <fmt/format.h>

namespace pelvireg::cli
{
namespace
{
/// The truth is given on the registration's own surfaces: both cases must have the same.
void require_same_pelvis(const dataset::Anatomy &anatomy, const dataset::Anatomy &driving, const std::string &driver)
{
  bool same = anatomy.registration.bodies.size() == driving.registration.bodies.size();
  for (std::size_t i = 0; same && i < anatomy.registration.bodies.size(); ++i)
    same = anatomy.registration.bodies[i].points == driving.registration.bodies[i].points;
  if (!same)
    throw InputError(
        fmt::format("Case '{}' generates itself from '{}', but the registration's meshes of the two differ; "
                    "give both the same pelvis (base = \"{}\").",
                    anatomy.case_name, driver, driver));
}
} // namespace

void make_self_generated_truth(ResultDirectory &directory, const std::string &driver, int jobs)
{
  const std::filesystem::path folder = directory.path() / "driver";
  const std::string text = anatomy::case_text(driver);
  if (anatomy::self_generated_from(text, driver))
    throw InputError(fmt::format("The case generates itself from '{}', which generates itself too; give a case whose "
                                 "truth is the reference's as self_generated_from.",
                                 driver));
  {
    ResultDirectory driving(folder, "driver of " + directory.path().string(), ResultDirectory::Missing::create);
    make_anatomy(driving, driver, text);
    make_truth(driving, jobs, "", (directory.path() / ".." / driver).lexically_normal());
    make_observations(driving);
    make_estimate(driving, {.condition = "full", .perturbation = {}, .samples = 0}, jobs);
  }
  directory.run(
      {.name = "reference",
       .code = {"validation/runner", "synthetic/dataset"},
       .options = "self-generated from " + driver + " " + sha256_of_file(folder / "estimate-full.h5"),
       .inputs = {"anatomy.h5"},
       .outputs = {"truth.h5"},
       .work = [&](Progress &) -> Notes
       {
         const dataset::Anatomy anatomy = dataset::load_anatomy(directory.path() / "anatomy.h5");
         require_same_pelvis(anatomy, dataset::load_anatomy(folder / "anatomy.h5"), driver);
         save(runner::self_generated_truth(anatomy, dataset::load_estimate(folder / "estimate-full.h5"), driver),
              directory.path() / "truth.h5");
         return {};
       }});
}
} // namespace pelvireg::cli
