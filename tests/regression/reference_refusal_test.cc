// What cannot be solved is refused before the solve starts; what does not converge ends with step, residual and cause.
// Neither leaves a truth.h5.
#include "synthetic/anatomy/case.h"
#include "tests/regression/program.h"

namespace pelvireg
{
namespace
{
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Reference : public Program
{
protected:
  Reference() : anatomy_(anatomy::build_anatomy(anatomy::case_text("quick"), "quick"))
  {
    std::filesystem::create_directory(folder_ / "result");
  }

  dataset::ReferenceShell &shell(const std::string &name)
  {
    for (dataset::ReferenceShell &found : anatomy_.reference.shells)
      if (found.name == name)
        return found;
    throw std::out_of_range(name);
  }

  Outcome solve() const
  {
    save(anatomy_, folder_ / "result" / "anatomy.h5");
    return call("reference result");
  }

  void expect_only_the_anatomy_left() const
  {
    EXPECT_THAT(files(), ::testing::UnorderedElementsAre("result", "result/anatomy.h5"));
  }

  void expect_model_refused(const std::string &part, const std::string &remedy) const
  {
    const Outcome outcome = solve();
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(part), HasSubstr(remedy)));
    EXPECT_THAT(outcome.out, Not(HasSubstr("unknowns"))); // the first word of the solve
    expect_only_the_anatomy_left();
  }

  dataset::Anatomy anatomy_;
};

TEST_F(Reference, RefusesAnOpenSurfaceWhereACavityIsAsked)
{
  shell("rectum").rims.pop_back();
  expect_model_refused("shell 'rectum': a cavity is asked but the surface is open", "close it");
}

TEST_F(Reference, RefusesAnInvertedElement)
{
  dataset::ReferenceShell &bladder = shell("bladder");
  const auto middle = bladder.cells(3, 8);
  bladder.midsurface.row(middle) -= 30 * bladder.directors.row(middle); // far through the other nodes' plane
  bladder.directors.row(middle) *= -1;
  expect_model_refused("shell 'bladder': cell 3 is inverted", "refine the mesh");
}

TEST_F(Reference, RefusesAnUnknownMaterial)
{
  anatomy_.reference.materials.erase("rectum");
  expect_model_refused("lacks the material 'rectum'", "make the file again");
}

TEST_F(Reference, RefusesABodyThatNothingHolds)
{
  anatomy_.reference.ties.clear();
  std::erase_if(anatomy_.reference.trusses,
                [](const dataset::ReferenceTruss &bar) { return bar.part_a == "uterus" || bar.part_b == "uterus"; });
  expect_model_refused("part 'uterus' is held by nothing", "give it a support");
}

TEST_F(Reference, EndsADivergenceWithStepResidualAndCause)
{
  // A bulk modulus of a million MPa: the round-off of the forces is above the tolerance of the residual.
  for (auto &[name, material] : anatomy_.reference.materials)
    material.kappa = 1e9;
  const Outcome outcome = solve();
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("did not converge beyond a mean vaginal displacement of"),
                                 HasSubstr("residual"), HasSubstr("likely cause")));
  expect_only_the_anatomy_left();
}
} // namespace
} // namespace pelvireg
