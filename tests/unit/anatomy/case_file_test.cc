// Bad case files: one sentence that names the key, the value, what is allowed and the remedy.
#include "synthetic/anatomy/case.h"
#include "synthetic/dataset/error.h"

#include <gtest/gtest.h>

#include <map>

namespace pelvireg::test
{
namespace
{
/// Case t005 with one piece of text replaced.
std::string altered(const std::string &from, const std::string &to)
{
  std::string text = anatomy::case_text("t005");
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string complaint(const std::string &text)
{
  try
  {
    anatomy::build_anatomy(text, "bad");
  }
  catch (const InputError &error)
  {
    return error.what();
  }
  return "";
}

void expect_complaint(const std::string &text, const std::vector<std::string> &pieces)
{
  const std::string message = complaint(text);
  for (const std::string &piece : pieces)
    EXPECT_NE(message.find(piece), std::string::npos) << "'" << piece << "' is not in: " << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST(CaseFile, RefusesNegativeThickness)
{
  expect_complaint(altered("wall = 3.5", "wall = -3.5"), {"vagina.wall", "-3.5", "> 0"});
}

TEST(CaseFile, RefusesZeroThickness)
{
  expect_complaint(altered("wall = 3.5", "wall = 0"), {"vagina.wall", "is 0", "> 0"});
}

TEST(CaseFile, RefusesZeroModulus)
{
  expect_complaint(altered("uterus = 0.60", "uterus = 0.0"), {"registration.youngs_modulus.uterus", "is 0", "> 0"});
}

TEST(CaseFile, RefusesNotANumber)
{
  expect_complaint(altered("tilt = 3.0", "tilt = nan"), {"plane.tilt", "nan", "-30"});
}

TEST(CaseFile, RefusesAnUnknownKeyAndListsTheKnownOnes)
{
  expect_complaint(altered("tilt = 3.0", "tilt = 3.0\ntild = 1"), {"plane.tild", "not a known key", "tilt", "remove"});
}

TEST(CaseFile, RefusesATensionOnlyFlagThatIsNoBoolean)
{
  expect_complaint(altered("n_bars = 8\n", "n_bars = 8\ntension_only = 1\n"), {"tension_only", "true or false"});
}

TEST(CaseFile, RefusesAMissingKey)
{
  expect_complaint(altered("tilt = 3.0", ""), {"plane.tilt", "missing"});
}

TEST(CaseFile, RefusesAWrongType)
{
  expect_complaint(altered("tilt = 3.0", "tilt = \"three\""), {"plane.tilt", "a string", "number"});
  expect_complaint(altered("n_increments = 15", "n_increments = 1.5"), {"load.n_increments", "1.5", "integer"});
  expect_complaint(altered("far_point = [0.0, 5.0, -6.0]", "far_point = [0.0, 5.0]"),
                   {"urethra.far_point", "3 numbers", "array of 2"});
}

TEST(CaseFile, ReadsWhatHoldsTheFluidsInTheUnitsOfTheCaseFile)
{
  const std::string text = altered("[plane]", "[cavity.bladder]\nmode = \"leak\"\nrate = 50.0\n[cavity.vagina]\n"
                                              "mode = \"pressure\"\npressure = 1.5\n[cavity.rectum]\n"
                                              "mode = \"open\"\n[plane]");
  const dataset::Anatomy anatomy = anatomy::build_anatomy(text, "altered");
  std::map<std::string, dataset::ReferenceShell> shells;
  for (const dataset::ReferenceShell &shell : anatomy.reference.shells)
    shells[shell.name] = shell;
  EXPECT_EQ(shells.at("bladder").cavity.mode, dataset::CavityMode::leak);
  EXPECT_DOUBLE_EQ(shells.at("bladder").cavity.leak_rate, 5e4); // mm^3 per MPa
  EXPECT_EQ(shells.at("vagina").cavity.mode, dataset::CavityMode::pressure);
  EXPECT_DOUBLE_EQ(shells.at("vagina").cavity.pressure, 1.5e-3); // MPa
  EXPECT_TRUE(shells.at("bladder").has_cavity && shells.at("vagina").has_cavity);
  EXPECT_FALSE(shells.at("rectum").has_cavity);
}

TEST(CaseFile, RefusesAFluidThatIsHeldByNothingItKnows)
{
  const auto with = [](const std::string &table) { return altered("[plane]", table + "\n[plane]"); };
  expect_complaint(with("[cavity.bladder]\nmode = \"leaky\""),
                   {"cavity.bladder.mode", "leaky", "closed, leak, pressure"});
  expect_complaint(with("[cavity.bladder]\nmode = \"leak\""), {"cavity.bladder.rate", "missing"});
  expect_complaint(with("[cavity.bladder]\nmode = \"leak\"\nrate = -1.0"), {"cavity.bladder.rate", "-1"});
  expect_complaint(with("[cavity.vagina]\nmode = \"closed\"\nrate = 1.0"), {"cavity.vagina.rate", "not a known key"});
  expect_complaint(with("[cavity.uterus]\nmode = \"closed\""), {"cavity.uterus", "bladder, vagina and rectum"});
}

TEST(CaseFile, RefusesAWallThatFolds)
{
  expect_complaint(altered("wall = 3.5", "wall = 5.3"), {"vagina.wall", "5.3", "0.8", "thinner"});
}

TEST(CaseFile, AcceptsAWallUpToTheBorder)
{
  EXPECT_EQ(complaint(altered("wall = 3.5", "wall = 5.19")), "");
}

TEST(CaseFile, RefusesAnUndefinedMaterial)
{
  expect_complaint(altered("urethra = \"bladder\"", "urethra = \"rubber\""),
                   {"reference.material_of.urethra", "rubber"});
}

TEST(CaseFile, RefusesADirectionOfNoLength)
{
  expect_complaint(altered("normal = [0.0, 0.656, 0.754]", "normal = [0, 0, 0]"),
                   {"retropubic.normal", "is zero", "direction"});
}

TEST(CaseFile, RefusesOrgansThatOverlap)
{
  expect_complaint(altered("fundus = [0.0, 5.0, 101.0]", "fundus = [0.0, -15.0, 88.0]"),
                   {"bladder", "uterus", "gap", "move them apart"});
}

TEST(CaseFile, RefusesNodeCountsThatNoMeshHas)
{
  expect_complaint(altered("bladder = 806", "bladder = 122"), {"registration.nodes.bladder", "122", "nearest"});
}

TEST(CaseFile, RefusesBrokenTomlWithItsLine)
{
  expect_complaint("name = \"x\"\nthis is not toml\n", {"line 2"});
}

TEST(CaseFile, RefusesAnUnknownNameAndListsTheBuiltInOnes)
{
  try
  {
    anatomy::case_text("t006");
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("t005, t005_large, t007, t007_large, t005_selfgen, quick"),
              std::string::npos)
        << error.what();
  }
  EXPECT_THROW(anatomy::case_text("/nowhere/at/all.toml"), InputError);
}

TEST(CaseFile, ListsTheBuiltInCases)
{
  std::vector<std::string> names;
  for (const anatomy::CaseSummary &summary : anatomy::built_in_cases())
    names.push_back(summary.name);
  EXPECT_EQ(names, (std::vector<std::string>{"t005", "t005_large", "t007", "t007_large", "t005_selfgen", "quick",
                                             "t005_half_stiffness", "t005_double_stiffness", "t005_neo_hookean",
                                             "t005_moved_insertions", "t005_leaking"}));
}

TEST(CaseFile, WithABaseIsThatCaseWithItsOwnValuesInPlace)
{
  const std::string changes = "base = \"t005\"\nname = \"mine\"\n[load]\ntarget_displacement = 4.0\n"
                              "[[support]]\nname = \"round\"\narea_left = 9.0\n";
  std::string expected = altered("name = \"t005\"", "name = \"mine\"");
  for (const auto &[from, to] : {std::pair{"target_displacement = 8.2", "target_displacement = 4.0"},
                                 std::pair{"area_left = 5.0", "area_left = 9.0"}})
    expected.replace(expected.find(from), std::string(from).size(), to);
  const auto canonical = [](const std::string &text) { return anatomy::with_value(text, "mine", "name", "'mine'"); };
  EXPECT_EQ(canonical(anatomy::with_base(changes, "mine")), canonical(expected));
  EXPECT_EQ(anatomy::with_base(expected, "mine"), expected); // no base: as it is, comments included
}

TEST(CaseFile, WithABaseAppendsTablesOfANewName)
{
  const std::string text = anatomy::with_base("base = \"t005\"\n[[support]]\nname = \"new\"\n", "mine");
  EXPECT_NE(text.find("'round'"), std::string::npos);
  EXPECT_NE(text.find("'new'"), std::string::npos);
}

TEST(CaseFile, RefusesABaseThatIsNoOtherCase)
{
  const auto complaint_about = [](const std::string &text, const std::string &name)
  {
    try
    {
      anatomy::with_base(text, name);
    }
    catch (const InputError &error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(complaint_about("base = \"t004\"", "mine").find("'t004'"), std::string::npos);
  EXPECT_NE(complaint_about("base = \"t004\"", "mine").find("t005, t005_large, t007, t007_large, t005_selfgen, quick"),
            std::string::npos);
  EXPECT_NE(complaint_about("base = 5", "mine").find("not a string"), std::string::npos);
  EXPECT_NE(complaint_about("base = \"t005\"", "t005").find("another built-in case"), std::string::npos);
}
} // namespace
} // namespace pelvireg::test
