#include "tests/scratch_folder.h"
#include "validation/report/html.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

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

std::string url_of(const std::string &bytes)
{
  const test::ScratchFolder folder;
  std::ofstream(folder / "picture.png", std::ios::binary) << bytes;
  return png_data_url(folder / "picture.png");
}

TEST(PngDataUrl, IsBase64OfTheBytes)
{
  // RFC 4648: "f", "fo", "foo" end in "==", "=" and nothing.
  const std::string head = "\x89PNG\r\n\x1a\n";
  EXPECT_EQ(url_of(head + "f"), "data:image/png;base64,iVBORw0KGgpm");
  EXPECT_EQ(url_of(head + "fo"), "data:image/png;base64,iVBORw0KGgpmbw==");
  EXPECT_EQ(url_of(head + "foo"), "data:image/png;base64,iVBORw0KGgpmb28=");
}

TEST(PngDataUrl, OfAnythingElseIsEmpty)
{
  EXPECT_EQ(url_of("<svg onload=\"x\">"), "");
  EXPECT_EQ(png_data_url("/nowhere/at/all.png"), "");
}
} // namespace
} // namespace pelvireg::report
