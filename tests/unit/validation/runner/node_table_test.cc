#include "validation/runner/node_table.h"

#include "validation/runner/table_one.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace pelvireg::runner
{
namespace
{
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<BodySize> sizes_of(const TableOneColumn &column)
{
  std::vector<BodySize> sizes;
  for (std::size_t i = 0; i < table_one_bodies.size(); ++i)
    sizes.push_back({table_one_bodies[i], column.nodes[i]});
  return sizes;
}

std::string line_of(const std::string &table, const std::string &title)
{
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);)
    if (line.rfind(title, 0) == 0)
      return line;
  return "no line of " + title;
}

TEST(TableOne, SumsToTheCountsThatTheDesignStates)
{
  EXPECT_EQ(table_one[0].n_nodes(), 4025);
  EXPECT_EQ(table_one[1].n_nodes(), 6200);
}

TEST(TableOne, AColumnHasTheSizeOfCountsWithinFivePercent)
{
  EXPECT_EQ(table_one_column(4226), &table_one[0]) << "4.99 % more";
  EXPECT_EQ(table_one_column(4227), nullptr) << "5.02 % more";
  EXPECT_EQ(table_one_column(3824), &table_one[0]) << "4.99 % fewer";
  EXPECT_EQ(table_one_column(3823), nullptr);
  EXPECT_EQ(table_one_column(6200), &table_one[1]);
  EXPECT_EQ(table_one_column(0), nullptr);
}

TEST(NodeTable, ShowsOursTableOnesAndTheDifferenceOfEveryBodyAndOfAll)
{
  std::vector<BodySize> sizes = sizes_of(table_one[0]);
  sizes[0].n_nodes += 46; // 4.96 %
  const std::string table = node_table(sizes);
  EXPECT_THAT(line_of(table, "this case"), AllOf(HasSubstr(" 974 "), HasSubstr(" 806 "), HasSubstr(" 4071")));
  EXPECT_THAT(line_of(table, "Table 1, T005"), AllOf(HasSubstr(" 928 "), HasSubstr(" 199 "), HasSubstr(" 4025")));
  EXPECT_THAT(line_of(table, "difference, %"), AllOf(HasSubstr(" +5.0 "), HasSubstr(" +1.1"), Not(HasSubstr("!"))));
}

TEST(NodeTable, MarksABodyThatIsOffByMoreThanFivePercentThoughTheSumIsNot)
{
  std::vector<BodySize> sizes = sizes_of(table_one[1]);
  sizes[6].n_nodes -= 12; // 5.15 % of 233
  EXPECT_THAT(line_of(node_table(sizes), "difference, %"), AllOf(HasSubstr("! -5.2 "), HasSubstr(" -0.2")));
}

TEST(NodeTable, OfAnotherSizeNamesTheSizesThatTableOneHas)
{
  const std::string table = node_table({{"bladder", 100}, {"ligaments", 7}});
  EXPECT_THAT(table, AllOf(HasSubstr(" 107\n"), HasSubstr("4025 (T005) or 6200 (T007)"), Not(HasSubstr("difference"))));
  EXPECT_EQ(table_one_nodes({{"bladder", 100}}, "bladder"), 0);
}

TEST(NodeTable, OfABodyThatTableOneDoesNotHaveShowsTheCountAlone)
{
  std::vector<BodySize> sizes = sizes_of(table_one[0]);
  sizes.push_back({"pelvic_floor", 33});
  EXPECT_THAT(line_of(node_table(sizes), "difference, %"), HasSubstr(" - "));
}
} // namespace
} // namespace pelvireg::runner
