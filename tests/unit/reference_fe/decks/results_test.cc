// Results of other programs: known numbers come back, damaged files are refused.
#include "reference_fe/decks/decks.h"
#include "synthetic/dataset/error.h"
#include "tests/unit/reference_fe/decks/sample_deck.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace pelvireg::reference_fe
{
namespace
{
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::map<int, Eigen::Vector3d> three_nodes = {{1, {0, 0, 0}}, {2, {10, -2.5, 0.125}}, {7, {-3, 4, 5}}};

Eigen::Vector3d stretch(const Eigen::Vector3d &x)
{
  return {0.25 * x[0], -0.5 * x[1], 1};
}

std::string good_frd()
{
  return frd_text(three_nodes, {1, 2}, stretch);
}

const std::string good_csv = "increment,node,u1,u2,u3\n1,1,0,0,1\n1,2,2.5,1.25,1\n1,7,-0.75,-2,1\n"
                             "2,7,-1.5,-4,2\n2,1,0,0,2\n2,2,5e0,2.5,+2\n";

std::string replaced(std::string text, const std::string &part, const std::string &by)
{
  const std::size_t place = text.rfind(part);
  EXPECT_NE(place, std::string::npos) << part;
  return place == std::string::npos ? text : text.replace(place, part.size(), by);
}

using Reader = NodalResults (*)(const std::filesystem::path &);

/// The sentence with which a reader refuses a text.
std::string sentence_of(Reader read, const std::string &text)
{
  const ScratchFile file(".txt", text);
  try
  {
    read(file.path());
  }
  catch (const InputError &error)
  {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "nothing was refused";
}

void expect_known_numbers(const NodalResults &results)
{
  EXPECT_THAT(results.ids, ElementsAre(1, 2, 7));
  EXPECT_THAT(results.times, ElementsAre(1, 2));
  ASSERT_EQ(results.displacements.size(), 2u);
  dataset::Points expected(3, 3);
  expected << 0, 0, 2, 5, 2.5, 2, -1.5, -4, 2;
  EXPECT_EQ(results.displacements[1], expected);
  EXPECT_EQ(results.displacements[0], dataset::Points(0.5 * expected));
}
} // namespace

TEST(FrdReader, GivesKnownNumbersBack)
{
  const ScratchFile file(".frd", good_frd());
  const NodalResults results = read_frd(file.path());
  expect_known_numbers(results);
  dataset::Points rest(3, 3);
  rest << 0, 0, 0, 10, -2.5, 0.125, -3, 4, 5;
  EXPECT_EQ(results.rest.value(), rest);
}

TEST(FrdReader, RefusesAFileCutAnywhere)
{
  const std::string good = good_frd();
  for (std::size_t length = 0; length + 5 < good.size(); length += 7) // the last line is " 9999"
  {
    const ScratchFile file(".frd", good.substr(0, length));
    EXPECT_THROW(read_frd(file.path()), InputError) << length << " of " << good.size() << " bytes";
  }
}

TEST(FrdReader, RefusesDamage)
{
  const std::string good = good_frd();
  const auto expect_refused = [&](const std::string &part, const std::string &by, const std::string &word)
  { EXPECT_THAT(sentence_of(read_frd, replaced(good, part, by)), HasSubstr(word)) << by; };
  expect_refused(" 5.00000E+00", "         NaN", "finite");
  expect_refused(" 5.00000E+00", "    Infinity", "finite");
  expect_refused(" 5.00000E+00", "            ", "finite");
  expect_refused(" 5.00000E+00", " 5.00000X+00", "line ");
  expect_refused(" -1         2", " -1         1", "ascend");
  expect_refused(" -1         2", " -1         3", "other nodes");
  expect_refused(" -1         2", " -1         x", "integer");
  expect_refused(" -1         2", " -7         2", "begin with -1");
  expect_refused("    2C                             3", "    2C                             4", "announced 4");
  expect_refused("    2C                             3                                     1",
                 "    2C                             3                                     2", "binary");
  expect_refused("    2C  ", "    2X  ", "no nodes");
  EXPECT_THAT(sentence_of(read_frd, ""), HasSubstr("no nodes"));
  EXPECT_THAT(sentence_of(read_frd, std::string(1000, '\0')), HasSubstr("no nodes"));
  EXPECT_THROW(read_frd("/no/such/file.frd"), InputError);
  EXPECT_THROW(read_frd("/"), InputError);
}

TEST(DisplacementTable, GivesKnownNumbersBack)
{
  const ScratchFile file(".csv", good_csv);
  const NodalResults results = read_displacement_csv(file.path());
  expect_known_numbers(results);
  EXPECT_FALSE(results.rest.has_value());
}

TEST(DisplacementTable, RefusesDamage)
{
  const auto expect_refused = [&](const std::string &part, const std::string &by, const std::string &word)
  { EXPECT_THAT(sentence_of(read_displacement_csv, replaced(good_csv, part, by)), HasSubstr(word)) << by; };
  expect_refused("increment,node", "node,increment", "must be 'increment,node,u1,u2,u3'");
  expect_refused("5e0", "nan", "u1 = 'nan'");
  expect_refused("5e0", "inf", "u1 = 'inf'");
  expect_refused("5e0", "", "u1 = ''");
  expect_refused("5e0", "5e0 mm", "u1");
  expect_refused(",2.5,+2", ",2.5", "five values");
  expect_refused(",2.5,+2", ",2.5,2,2", "five values");
  expect_refused("2,7,-1.5", "3,7,-1.5", "increment 3 after increment 1");
  expect_refused("2,7,-1.5", "2,8,-1.5", "not the same nodes");
  expect_refused("2,7,-1.5", "2,0,-1.5", "node '0'");
  expect_refused("2,7,-1.5", "2,99999999999,-1.5", "node '99999999999'");
  expect_refused("2,1,0,0,2", "2,7,0,0,2", "second time");
  expect_refused("2,7,-1.5,-4,2\n", "", "increment 2 has 2 nodes");
  EXPECT_THAT(sentence_of(read_displacement_csv, "increment,node,u1,u2,u3\n"), HasSubstr("no displacement"));
  EXPECT_THAT(sentence_of(read_displacement_csv, ""), HasSubstr("no displacement"));
  EXPECT_THROW(read_displacement_csv("/no/such/file.csv"), InputError);
}

TEST(ImportedTruth, BringsEveryAffineMotionOfTheDeckBack)
{
  const dataset::Anatomy anatomy = sample_deck_anatomy();
  Eigen::Matrix3d gradient;
  gradient << 0.1, -0.2, 0.05, 0.3, 0.1, 0, -0.1, 0.2, 0.15;
  const Field motion = [&](const Eigen::Vector3d &x)
  { return Eigen::Vector3d(gradient * x + Eigen::Vector3d(1, 2, 3)); };
  for (const int layers : {1, 2, 3})
  {
    const DeckMesh mesh(anatomy.reference, layers);
    const ScratchFile file(".frd", frd_text(mesh.nodes(), {1, 2}, motion));
    const dataset::Truth truth = imported_truth(anatomy, read_frd(file.path()), "somebody else", 0.008);
    EXPECT_EQ(truth.source, "somebody else");
    ASSERT_EQ(truth.surfaces.size(), 2u);
    EXPECT_EQ(truth.surfaces[0].name, "vagina");
    EXPECT_EQ(truth.surfaces[0].rest.points.rows(), 9); // the centre node too
    for (const dataset::TruthSurface &surface : truth.surfaces)
      for (std::size_t i = 0; i < 2; ++i)
        for (Eigen::Index v = 0; v < surface.rest.points.rows(); ++v)
          EXPECT_LT((surface.displacements[i].row(v).transpose() -
                     static_cast<double>(i + 1) * motion(surface.rest.points.row(v).transpose()))
                        .norm(),
                    1e-4); // six digits
    ASSERT_EQ(truth.trusses.size(), 2u);
    EXPECT_LT(
        (truth.trusses[1].positions[1].row(0).transpose() - Eigen::Vector3d(2, 2, 0) - 2 * motion({2, 2, 0})).norm(),
        1e-4);
    ASSERT_EQ(truth.increments.size(), 2u);
    EXPECT_DOUBLE_EQ(truth.increments[0].pressure, 0.004);
    EXPECT_DOUBLE_EQ(truth.increments[1].pressure, 0.008);
    EXPECT_EQ(truth.increments[0].max_penetration, -1);
  }
}

TEST(ImportedTruth, MeasuresTheMeanDisplacementInThePlane)
{
  const dataset::Anatomy anatomy = sample_deck_anatomy();
  const DeckMesh mesh(anatomy.reference, 1);
  const ScratchFile file(
      ".frd", frd_text(mesh.nodes(), {1, 2}, [](const Eigen::Vector3d &) { return Eigen::Vector3d(7, 3, 4); }));
  const dataset::Truth truth = imported_truth(anatomy, read_frd(file.path()), "", 0);
  EXPECT_NEAR(truth.increments[0].mean_vaginal_displacement, 5, 1e-4);
  EXPECT_NEAR(truth.increments[1].mean_vaginal_displacement, 10, 1e-4);
}

TEST(ImportedTruth, RefusesResultsOfAnotherDeck)
{
  const dataset::Anatomy anatomy = sample_deck_anatomy();
  const auto sentence = [&](const std::map<int, Eigen::Vector3d> &nodes, const std::vector<double> &times)
  {
    const ScratchFile file(".frd", frd_text(nodes, times, stretch));
    try
    {
      imported_truth(anatomy, read_frd(file.path()), "", 0);
    }
    catch (const InputError &error)
    {
      return std::string(error.what());
    }
    return std::string("nothing was refused");
  };
  const std::map<int, Eigen::Vector3d> good = DeckMesh(anatomy.reference, 1).nodes();
  EXPECT_EQ(sentence(good, {1, 2}), "nothing was refused");
  EXPECT_THAT(sentence(good, {1}), HasSubstr("must be at the 2 times"));
  EXPECT_THAT(sentence(good, {}), HasSubstr("at 0 times"));
  EXPECT_THAT(sentence(good, {1, 2, 2.5}), HasSubstr("the last 2.5"));
  EXPECT_THAT(sentence(good, {1, 1.75}), HasSubstr("the last 1.75"));
  EXPECT_THAT(sentence(good, {2, 1}), HasSubstr("at 2 times"));
  std::map<int, Eigen::Vector3d> other = good;
  other.erase(3);
  EXPECT_THAT(sentence(other, {1, 2}), HasSubstr(fmt::format("have {} nodes", good.size() - 1)));
  other = good;
  other[9] = {0, 0, 0};
  EXPECT_THAT(sentence(other, {1, 2}), HasSubstr(fmt::format("has {}, ", good.size())));
  other = good;
  other[3][1] += 0.01;
  EXPECT_THAT(sentence(other, {1, 2}), HasSubstr("node 3 of the results lies at"));
}
} // namespace pelvireg::reference_fe
