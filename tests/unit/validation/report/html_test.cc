#include "validation/report/html.h"

#include <gtest/gtest.h>

namespace pelvireg::report
{
namespace
{
TEST(Escape, LeavesNothingThatHtmlWouldRead)
{
  EXPECT_EQ(escape("<a href=\"x\">&'</a>"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;&lt;/a&gt;");
  EXPECT_EQ(escape("8.2 mm ±"), "8.2 mm ±");
}

TEST(Table, EscapesCellsAndFillsShortRows)
{
  const std::string html = table({"a", "b"}, {{"<x>"}});
  EXPECT_NE(html.find("<th scope=\"row\">&lt;x&gt;</th><td></td>"), std::string::npos);
}

TEST(JpegDataUrl, IsBase64OfTheBytes)
{
  // RFC 4648: "f", "fo", "foo" end in "==", "=" and nothing; three bytes of the head are four characters.
  const std::string head = "\xFF\xD8\xFF";
  EXPECT_EQ(jpeg_data_url(head + "f"), "data:image/jpeg;base64,/9j/Zg==");
  EXPECT_EQ(jpeg_data_url(head + "fo"), "data:image/jpeg;base64,/9j/Zm8=");
  EXPECT_EQ(jpeg_data_url(head + "foo"), "data:image/jpeg;base64,/9j/Zm9v");
}

TEST(JpegDataUrl, OfAnythingElseIsEmpty)
{
  EXPECT_EQ(jpeg_data_url("<svg onload=\"x\">"), "");
  EXPECT_EQ(jpeg_data_url(""), "");
}
} // namespace
} // namespace pelvireg::report
