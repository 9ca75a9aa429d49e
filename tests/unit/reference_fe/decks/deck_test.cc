// The deck as text: numbering, elements, what is said to be left out.
#include "reference_fe/decks/decks.h"
#include "synthetic/dataset/error.h"
#include "tests/unit/reference_fe/decks/sample_deck.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>
#include <limits>

namespace pelvireg::reference_fe
{
namespace
{
using ::testing::HasSubstr;
using ::testing::Not;

/// Volume of a 20-node brick with straight, parallel edges: from three of its edges.
double box_volume(const DeckMesh &mesh, const std::vector<int> &nodes)
{
  const auto edge = [&](std::size_t k) -> Eigen::Vector3d
  { return mesh.nodes().at(nodes[k]) - mesh.nodes().at(nodes[0]); };
  Eigen::Matrix3d edges;
  edges << edge(1), edge(3), edge(4);
  return edges.determinant();
}

/// Where the mid-side nodes of a brick must lie: between these corners, in Abaqus' order.
constexpr int brick_edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                    {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

std::string sentence_of(const dataset::Anatomy &anatomy, const DeckLoads &loads, const DeckOptions &options = {})
{
  try
  {
    abaqus_deck(anatomy, loads, options);
  }
  catch (const InputError &error)
  {
    return error.what();
  }
  return "nothing was refused";
}
} // namespace

TEST(DeckMesh, NumbersOuterNodesAlikeForEveryNumberOfLayers)
{
  const dataset::Anatomy anatomy = sample_deck_anatomy();
  for (const int layers : {1, 2, 3})
  {
    const DeckMesh mesh(anatomy.reference, layers);
    for (int n = 0; n < 8; ++n)
      EXPECT_EQ(mesh.nodes().at(1 + n),
                Eigen::Vector3d(anatomy.reference.shells[0].midsurface.row(n).transpose() + Eigen::Vector3d(0, 0, 1)));
    EXPECT_FALSE(mesh.nodes().contains(9)); // the centre
    for (int n = 0; n < 10; ++n)
      EXPECT_EQ(mesh.nodes().at(10 + n), Eigen::Vector3d(anatomy.reference.solids[0].points.row(n).transpose()));
  }
}

TEST(DeckMesh, FillsTheWallWithBricksThatStandUpright)
{
  for (const int layers : {1, 2, 3})
  {
    const DeckMesh mesh(sample_deck_anatomy().reference, layers);
    const DeckBody &wall = mesh.bodies()[0];
    ASSERT_EQ(wall.elements.size(), static_cast<std::size_t>(layers));
    double volume = 0;
    for (const std::vector<int> &nodes : wall.elements)
    {
      ASSERT_EQ(nodes.size(), 20u);
      volume += box_volume(mesh, nodes);
      for (std::size_t k = 0; k < 12; ++k)
        EXPECT_LT((mesh.nodes().at(nodes[8 + k]) -
                   0.5 * (mesh.nodes().at(nodes[brick_edges[k][0]]) + mesh.nodes().at(nodes[brick_edges[k][1]])))
                      .norm(),
                  1e-14);
    }
    EXPECT_NEAR(volume, 4 * 4 * 2, 1e-12);
    EXPECT_EQ(wall.outer_faces[0].element, layers);
    EXPECT_EQ(wall.inner_faces[0].element, 1);
  }
}

TEST(DeckMesh, CarriesPointsBetweenNodesByTheBricksShapeFunctions)
{
  const dataset::Anatomy anatomy = sample_deck_anatomy();
  // What 20 nodes of a brick represent: all quadratic fields and more.
  const auto field = [](const Eigen::Vector3d &x)
  { return 1 + x[0] * x[0] - 2 * x[1] * x[2] + x[2] * x[2] + x[0] * x[1] * x[2]; };
  for (const int layers : {1, 2, 3})
  {
    const DeckMesh mesh(anatomy.reference, layers);
    for (int n = 0; n < 9; ++n)
      for (const int side : {0, 1})
      {
        const DeckPoint point = side ? mesh.outer_point("vagina", n) : mesh.middle_point("vagina", n);
        double value = 0;
        for (std::size_t i = 0; i < point.nodes.size(); ++i)
          value += point.weights[i] * field(mesh.nodes().at(point.nodes[i]));
        EXPECT_NEAR(value,
                    field(anatomy.reference.shells[0].midsurface.row(n).transpose() + Eigen::Vector3d(0, 0, side)),
                    1e-12)
            << layers << " layers, node " << n << ", side " << side;
      }
  }
}

TEST(Deck, SaysWhatItGivesAndWhatNot)
{
  dataset::Anatomy anatomy = sample_deck_anatomy();
  anatomy.reference.shells[0].has_cavity = true;
  const std::string deck = abaqus_deck(anatomy, {{0.001, 0.0025}, {{"vagina", {0.5, 0.75}}}}, {});
  EXPECT_THAT(deck, HasSubstr("Not given: contact between parts (vagina-uterus)"));
  EXPECT_THAT(deck, HasSubstr("vagina (its pressure is given)"));
  EXPECT_THAT(abaqus_deck(anatomy, {{1}, {}}, {}), HasSubstr("vagina (empty)"));
  // D1 = 2 / kappa
  EXPECT_THAT(deck, HasSubstr("*HYPERELASTIC, YEOH\n0.25,0.5,0.125,0.05,1.e6,1.e6\n"));
  EXPECT_THAT(deck, HasSubstr("*HYPERELASTIC, NEO HOOKE\n0.125,0.125\n"));
  EXPECT_THAT(deck, HasSubstr("*AMPLITUDE, NAME=ABDOMINAL_PRESSURE, TIME=TOTAL TIME\n0.,0.,1.,0.001,2.,0.0025\n"));
  EXPECT_THAT(deck, HasSubstr("*AMPLITUDE, NAME=FLUID_VAGINA, TIME=TOTAL TIME\n0.,0.,1.,0.5,2.,0.75\n"));
  EXPECT_THAT(deck, HasSubstr("*SURFACE, NAME=VAGINA_PERITONEAL, TYPE=ELEMENT\n1,S2\n"));
  EXPECT_THAT(deck, HasSubstr("*SURFACE, NAME=UTERUS_PERITONEAL, TYPE=ELEMENT\n2,S3\n"));
  EXPECT_THAT(deck, HasSubstr("*SURFACE, NAME=VAGINA_INNER, TYPE=ELEMENT\n1,S1\n"));
  EXPECT_THAT(deck, HasSubstr("** increment 2\n*STEP, NLGEOM"));
  EXPECT_THAT(deck, Not(HasSubstr("** increment 3")));
}

TEST(Deck, GivesSpringsTheForceOfTheBars)
{
  const dataset::Anatomy anatomy = sample_deck_anatomy();
  const std::string deck = abaqus_deck(anatomy, {{1}, {}}, {.springs = true});
  EXPECT_THAT(deck, Not(HasSubstr("T3D2")));
  EXPECT_THAT(deck, Not(HasSubstr("*CONTROLS")));
  EXPECT_THAT(abaqus_deck(anatomy, {{1}, {}}, {}), HasSubstr("*CONTROLS"));
  // Length 9 mm, stretch 1.5: 3 mm^2 of Yeoh, 2 (1.5 - 1 / 1.5^2) (C10 + 2 C20 e + 3 C30 e^2), e = I1 - 3 = 7 / 12.
  const double e = 7. / 12, force = 3 * 2 * (1.5 - 1 / 2.25) * (0.25 + e + 0.375 * e * e);
  EXPECT_THAT(deck, HasSubstr(fmt::format("\n{:.9g},4.5\n", force)));
  EXPECT_THAT(deck, HasSubstr("\n0,0\n"));
}

TEST(Deck, IsTheSameTextEveryTime)
{
  const dataset::Anatomy anatomy = sample_deck_anatomy();
  EXPECT_EQ(abaqus_deck(anatomy, {{0.1, 0.2}, {}}, {2}), abaqus_deck(anatomy, {{0.1, 0.2}, {}}, {2}));
}

TEST(Deck, LetsNoNameBecomeAKeyword)
{
  dataset::Anatomy anatomy = sample_deck_anatomy();
  anatomy.case_name = "a\n*BOUNDARY\n1,1,3";
  anatomy.reference.contact_pairs = {{"vagina\n*STEP", "uterus"}};
  anatomy.reference.trusses[0].group = "1, x\n*DSLOAD";
  anatomy.reference.materials["wall\n*DENSITY"] = anatomy.reference.materials["wall"];
  const std::string deck = abaqus_deck(anatomy, {{1}, {}}, {});
  EXPECT_THAT(deck, HasSubstr("a_*BOUNDARY_1,1,3\n"));
  EXPECT_THAT(deck, HasSubstr("BARS_1_N_1__X__DSLOAD"));
  EXPECT_THAT(deck, HasSubstr("NAME=WALL__DENSITY\n"));
  for (const char *keyword : {"\n*BOUNDARY\n1,1,3", "\n*STEP\n", "\n*DSLOAD\n", "\n*DENSITY"})
    EXPECT_THAT(deck, Not(HasSubstr(keyword)));
}

TEST(Deck, PutsTheMeanShareOfThePressureOnAFace)
{
  dataset::Anatomy anatomy = sample_deck_anatomy();
  dataset::ReferenceShell &shell = anatomy.reference.shells[0];
  shell.pressure_share = shell.midsurface.col(0) / 4; // from 0 to 1 over the plate
  const std::string deck = abaqus_deck(anatomy, {{1}, {}}, {});
  EXPECT_THAT(deck, HasSubstr("*DLOAD, AMPLITUDE=ABDOMINAL_PRESSURE\n1,P2,0.5\n"));
  EXPECT_THAT(deck, Not(HasSubstr("VAGINA_PERITONEAL")));
  EXPECT_THAT(deck, HasSubstr("UTERUS_PERITONEAL")) << "without shares: whole faces of the region";
}

TEST(Deck, RefusesWhatItCannotWrite)
{
  const dataset::Anatomy good = sample_deck_anatomy();
  EXPECT_THAT(sentence_of(good, {}), HasSubstr("abdominal pressure"));
  EXPECT_THAT(sentence_of(good, {{std::nan("")}, {}}), HasSubstr("nan"));
  EXPECT_THAT(sentence_of(good, {{std::numeric_limits<double>::infinity()}, {}}), HasSubstr("inf"));
  EXPECT_THAT(sentence_of(good, {{1, 2}, {{"vagina", {1}}}}), HasSubstr("fluid pressure of 'vagina'"));
  EXPECT_THAT(sentence_of(good, {{1}, {}}, {0}), HasSubstr("1 to 8"));
  EXPECT_THAT(sentence_of(good, {{1}, {}}, {9}), HasSubstr("1 to 8"));
  dataset::Anatomy bad = good;
  bad.reference.materials["WALL"] = {};
  EXPECT_THAT(sentence_of(bad, {{1}, {}}), HasSubstr("same name 'WALL'"));
  bad = good;
  bad.reference.shells[0].region.setZero();
  bad.reference.solids[0].region.setZero();
  EXPECT_THAT(sentence_of(bad, {{1}, {}}), HasSubstr("peritoneal"));
  bad = good;
  bad.reference.ties = {{"vagina", "uterus"}};
  EXPECT_THAT(sentence_of(bad, {{1}, {}}), HasSubstr("cervix_patch"));
  bad = good;
  bad.reference.shells[0].cells(0, 8) = 4;
  EXPECT_THAT(sentence_of(bad, {{1}, {}}), HasSubstr("mid-side"));
}

TEST(CutParts, LetsBarsEndInSpace)
{
  const dataset::Anatomy whole = sample_deck_anatomy();
  const dataset::Anatomy plate_alone = cut_parts(whole, {"vagina"});
  ASSERT_EQ(plate_alone.reference.trusses.size(), 2u);
  EXPECT_EQ(plate_alone.reference.trusses[1].part_b, "");
  EXPECT_EQ(plate_alone.reference.trusses[1].fixed_point, Eigen::Vector3d(0, 0, 7));
  EXPECT_TRUE(plate_alone.reference.solids.empty());
  EXPECT_TRUE(plate_alone.reference.contact_pairs.empty());
  const dataset::Anatomy solid_alone = cut_parts(whole, {"uterus"});
  ASSERT_EQ(solid_alone.reference.trusses.size(), 1u);
  EXPECT_EQ(solid_alone.reference.trusses[0].part_a, "uterus");
  EXPECT_EQ(solid_alone.reference.trusses[0].node_a, 3);
  EXPECT_EQ(solid_alone.reference.trusses[0].fixed_point, Eigen::Vector3d(2, 2, 0));
  EXPECT_THROW(cut_parts(whole, {"bladder"}), InputError);
  EXPECT_THROW(cut_parts(whole, {}), InputError);
}
} // namespace pelvireg::reference_fe
