#include "tests/architecture/include_rules.h"

#include <algorithm>
#include <regex>
#include <sstream>

namespace pelvireg::architecture
{
namespace
{
bool starts_with_any(const std::string &text, const std::vector<std::string> &prefixes)
{
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](const std::string &prefix) { return text.rfind(prefix, 0) == 0; });
}

/// A folder and the paths of ours that its files may include. The first rule whose folder fits a file holds.
struct DirectionRule
{
  std::string folder;
  std::vector<std::string> may_include;
};

const std::vector<DirectionRule> direction_rules = {
    {"registration/tracking/", {"registration/tracking/"}},
    {"registration/", {"registration/"}},
    {"reference_fe/", {"reference_fe/", "synthetic/dataset/"}},
    {"synthetic/dataset/", {"synthetic/dataset/"}},
    {"synthetic/anatomy/", {"synthetic/anatomy/", "synthetic/dataset/"}},
    {"synthetic/observation/", {"synthetic/observation/", "synthetic/dataset/"}},
    {"validation/metrics/", {"validation/metrics/", "synthetic/dataset/"}},
    // The program links everything, but only through each folder's public entries.
    {"validation/cli/",
     {"validation/", "synthetic/dataset/", "registration/registration.h", "registration/tracking/outline_tracker.h",
      "reference_fe/reference.h", "reference_fe/decks/decks.h", "synthetic/anatomy/case.h",
      "synthetic/observation/observe.h", "synthetic/observation/images/image_files.h",
      "synthetic/observation/images/make_images.h"}},
    {"validation/",
     {"validation/metrics/", "validation/runner/", "validation/regression/", "validation/report/", "synthetic/dataset/",
      "registration/registration.h", "registration/tracking/outline_tracker.h"}},
    {"tests/", {"tests/", "registration/", "reference_fe/", "synthetic/", "validation/"}},
};

/// A library, how its headers begin, and the folders that may know it. Tests may use any of them as an oracle.
struct LibraryRule
{
  std::string library;
  std::vector<std::string> headers;
  std::vector<std::string> folders;
};

const std::vector<LibraryRule> library_rules = {
    {"deal.II", {"deal.II/"}, {"reference_fe/", "tests/"}},
    {"gmsh", {"gmsh.h"}, {"synthetic/anatomy/", "tests/unit/anatomy/"}},
    {"VTK", {"vtk"}, {"validation/report/", "tests/"}},
    {"HDF5", {"hdf5", "H5"}, {"synthetic/dataset/", "tests/unit/dataset/"}},
    {"OpenCV", {"opencv2/"}, {"registration/tracking/", "tests/"}},
    {"GDCM", {"gdcm"}, {"synthetic/observation/images/", "tests/unit/observation/"}},
};

std::string join(const std::vector<std::string> &words)
{
  std::string text;
  for (const std::string &word : words)
    text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string problem_of_quoted(const std::string &file, const std::string &included,
                              const std::set<std::string> &known_files)
{
  if (!known_files.contains(included))
    return "\"" + included + "\" is not the full path from the root of a file of ours";
  for (const DirectionRule &rule : direction_rules)
    if (file.rfind(rule.folder, 0) == 0)
      return starts_with_any(included, rule.may_include)
                 ? ""
                 : "\"" + included + "\" is out of bounds; " + rule.folder + " may include " + join(rule.may_include);
  return "no rule covers this folder; add one to include_rules.cc";
}

std::string problem_of_library(const std::string &file, const std::string &included)
{
  for (const LibraryRule &rule : library_rules)
    if (starts_with_any(included, rule.headers) && !starts_with_any(file, rule.folders))
      return "<" + included + "> brings " + rule.library + ", which belongs to " + join(rule.folders);
  return "";
}
} // namespace

std::vector<std::string> include_problems(const std::string &file, const std::string &text,
                                          const std::set<std::string> &known_files)
{
  static const std::regex include_line(R"re(^\s*#\s*include\s*(["<])([^">]+)[">].*)re");
  std::vector<std::string> problems;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);)
  {
    ++number;
    std::smatch match;
    if (!std::regex_match(line, match, include_line))
      continue;
    const std::string included = match[2];
    std::string problem = problem_of_library(file, included);
    if (problem.empty() && match[1] == "\"")
      problem = problem_of_quoted(file, included, known_files);
    if (problem.empty() && known_files.contains(included) && match[1] == "<")
      problem = "<" + included + "> is a file of ours; write it in quotes";
    if (!problem.empty())
      problems.push_back(file + ":" + std::to_string(number) + ": " + problem);
  }
  return problems;
}

std::set<std::string> source_files(const std::filesystem::path &root)
{
  std::set<std::string> files;
  for (const char *folder : {"registration", "reference_fe", "synthetic", "validation", "tests"})
    for (const auto &entry : std::filesystem::recursive_directory_iterator(root / folder))
    {
      const std::string extension = entry.path().extension().string();
      if (entry.is_regular_file() && (extension == ".h" || extension == ".cc" || extension == ".cu"))
        files.insert(entry.path().lexically_relative(root).generic_string());
    }
  return files;
}
} // namespace pelvireg::architecture
