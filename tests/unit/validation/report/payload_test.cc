#include "validation/report/payload.h"

#include "validation/report/base64.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <stdexcept>
#include <string>

namespace pelvireg::report
{
namespace
{
dataset::Points row(double x, double y, double z)
{
  dataset::Points points(1, 3);
  points << x, y, z;
  return points;
}

TEST(Base64, IsThatOfRfc4648)
{
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(PackPositions, KeepsTheFirstFrameAndFoldedDifferencesLowBytesFirst)
{
  // quanta: 300, -1, 0, then 301, -3, 0: differences 1, -2, 0. Folded: 600, 1, 0, 2, 3, 0.
  const std::string packed = pack_positions({row(3, -0.01, 0), row(3.01, -0.03, 0)}, 0.01);
  EXPECT_EQ(packed, std::string("\x58\x01\x00\x02\x03\x00", 6) + std::string("\x02\x00\x00\x00\x00\x00", 6));
}

TEST(PackPositions, RefusesWhatInt16CannotHold)
{
  EXPECT_NO_THROW(pack_positions({row(327.67, 0, 0)}, 0.01));
  EXPECT_THROW(pack_positions({row(327.68, 0, 0)}, 0.01), std::runtime_error);
  EXPECT_THROW(pack_positions({row(std::numeric_limits<double>::quiet_NaN(), 0, 0)}, 0.01), std::runtime_error);
}

TEST(PackPositions, SurvivesTheLargestJump)
{
  // -32767 to 32767 is 65534, which is -2 modulo 2^16: folded 3.
  const std::string packed = pack_positions({row(-327.67, 0, 0), row(327.67, 0, 0)}, 0.01);
  EXPECT_EQ(packed.substr(3, 3), std::string("\x03\x00\x00", 3));
}

TEST(PackValues, RoundsAndEndsAtTheLargest)
{
  // 2 and 255 quanta, then 1 and 255: differences 2, -1 (255), -1, 0
  EXPECT_EQ(pack_values({{0.09, 1e9}, {0.05, 10.2}}, 0.04), std::string("\x04\x01\x01\x00", 4));
}

TEST(PackIndices, RefusesWhatUint16CannotHold)
{
  EXPECT_EQ(pack_indices({258, 65535}), std::string("\x02\xff\x01\xff", 4));
  EXPECT_THROW(pack_indices({65536}), std::runtime_error);
  EXPECT_THROW(pack_indices({-1}), std::runtime_error);
}

TEST(Payload, IsTheSameForTheSameContentAndHoldsNoCharacterOfHtml)
{
  Payload payload;
  payload.add("a", "</script><script>");
  const nlohmann::ordered_json model = {{"case", "</script>"}};
  EXPECT_EQ(payload.encoded(model), payload.encoded(model));
  EXPECT_EQ(payload.encoded(model).find_first_of("<>&\"'"), std::string::npos);
}
} // namespace
} // namespace pelvireg::report
