// The pelvireg program as a person or CI calls it, in a folder of its own.
#pragma once

#include "tests/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <vector>

namespace pelvireg
{
inline std::string content_of(const std::filesystem::path &file)
{
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}

struct Outcome
{
  int status = -1;
  std::string out, err;
};

class Program : public ::testing::Test
{
protected:
  Outcome call(const std::string &arguments) const
  {
    const std::filesystem::path out = folder_ / "stdout", err = folder_ / "stderr";
    const std::string command = "cd '" + folder_.string() + "' && '" PELVIREG_PROGRAM "' " + arguments + " >'" +
                                out.string() + "' 2>'" + err.string() + "' </dev/null";
    const int status = std::system(command.c_str());
    Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(out), content_of(err)};
    std::filesystem::remove(out);
    std::filesystem::remove(err);
    return outcome;
  }

  /// Exit status 2, one sentence on standard error that holds `part`, no file left.
  void expect_refused(const std::string &arguments, const std::string &part) const
  {
    const Outcome outcome = call(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, ::testing::HasSubstr(part)) << arguments;
  }

  std::vector<std::string> files() const
  {
    std::vector<std::string> names;
    for (const auto &entry : std::filesystem::recursive_directory_iterator(folder_))
      names.push_back(entry.path().lexically_relative(folder_).string());
    return names;
  }

  const test::ScratchFolder scratch_;
  std::filesystem::path folder_ = scratch_.path();
};
} // namespace pelvireg
