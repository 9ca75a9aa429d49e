#include "tests/unit/validation/export/example.h"
#include "validation/report/pictures.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace pelvireg::report
{
namespace
{
using test::fresh_folder;
namespace fs = std::filesystem;

std::string content(const fs::path &file)
{
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Pictures, all_stills_are_drawn_without_a_display_and_are_the_same_twice)
{
  unsetenv("DISPLAY");
  const fs::path first = fresh_folder("pictures_1"), second = fresh_folder("pictures_2");
  for (const fs::path &folder : {first, second})
  {
    const RenderOutcome outcome = render_in_child("example", folder, RENDER_PROGRAM);
    ASSERT_TRUE(outcome.ok) << outcome.message;
    EXPECT_EQ(outcome.message, "");
  }
  for (const Picture &picture : picture_list())
  {
    const std::string bytes = content(first / picture.file);
    EXPECT_EQ(bytes.substr(0, 4), "\x89PNG") << picture.file;
    EXPECT_GT(bytes.size(), 8000u) << picture.file; // an empty picture of this size has about 4 kB
    EXPECT_EQ(bytes, content(second / picture.file)) << picture.file;
    EXPECT_FALSE(picture.caption.empty());
  }
  EXPECT_FALSE(fs::exists(first / "render.log"));
  fs::remove_all(first);
  fs::remove_all(second);
}

TEST(Pictures, a_child_that_aborts_fails_or_is_missing_gives_one_sentence)
{
  const fs::path folder = fresh_folder("pictures_failing");
  const auto message_of = [&](const char *result, const fs::path &program)
  {
    const RenderOutcome outcome = render_in_child(result, folder, program);
    EXPECT_FALSE(outcome.ok);
    EXPECT_FALSE(outcome.message.empty());
    EXPECT_EQ(outcome.message.find('\n'), std::string::npos);
    return outcome.message;
  };
  std::ofstream(folder / picture_list().front().file) << "of an earlier result";
  EXPECT_FALSE(message_of("abort", RENDER_PROGRAM).empty());
  EXPECT_FALSE(fs::exists(folder / picture_list().front().file));
  EXPECT_NE(message_of("fail", RENDER_PROGRAM).find("the anatomy is missing"), std::string::npos);
  message_of("example", "/no/such/program");
  fs::remove_all(folder);
}

TEST(Pictures, a_child_that_hangs_is_ended)
{
  const fs::path folder = fresh_folder("pictures_hanging");
  const RenderOutcome outcome = render_in_child("hang", folder, RENDER_PROGRAM, 3);
  EXPECT_FALSE(outcome.ok);
  EXPECT_NE(outcome.message.find("longer than 3 s"), std::string::npos);
  fs::remove_all(folder);
}

TEST(Pictures, without_xvfb_and_display_nothing_is_started)
{
  const std::string path = std::getenv("PATH") ? std::getenv("PATH") : "";
  unsetenv("DISPLAY");
  setenv("PATH", "/nowhere", 1);
  const fs::path folder = fresh_folder("pictures_without_xvfb");
  const RenderOutcome outcome = render_in_child("example", folder, RENDER_PROGRAM);
  setenv("PATH", path.c_str(), 1);
  EXPECT_FALSE(outcome.ok);
  EXPECT_NE(outcome.message.find("install the package xvfb"), std::string::npos);
  fs::remove_all(folder);
}
} // namespace
} // namespace pelvireg::report
