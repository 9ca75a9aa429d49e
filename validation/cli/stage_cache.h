// A stage that would give what is already there is not run again.
#pragma once

#include "validation/cli/manifest.h"
#include "validation/cli/progress.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pelvireg::cli
{
/// Figures that a stage hands on beside its files.
using Notes = std::map<std::string, double>;

/// One stage of the chain, inside one result directory.
struct Stage
{
  std::string name;                               ///< "anatomy", "register full", …
  std::vector<std::string> code;                  ///< folders whose sources decide the outputs, see version.h
  std::string options;                            ///< everything beside the inputs that the outputs depend on, as text
  std::vector<std::string> inputs;                ///< file names in the directory
  std::vector<std::string> outputs;               ///< file names in the directory
  std::vector<std::string> optional_outputs = {}; ///< recorded when the work made them
  std::function<Notes(Progress &)> work;          ///< makes every output, or throws
  /// Other result directories in which the same stage may have made the same outputs: copied instead of made again.
  std::vector<std::filesystem::path> elsewhere = {};
};

/// A result directory in use by this process, for as long as the object lives.
class ResultDirectory
{
public:
  enum class Missing
  {
    refuse, ///< a directory that does not exist is an InputError
    create  ///< it is made, and removed again when nothing came to lie in it
  };

  enum class Access
  {
    alone, ///< to run stages
    shared ///< beside others that also only read what is there and write files of their own; run() is not for them
  };

  /// Throws InputError when the directory cannot be opened or another pelvireg uses it.
  ResultDirectory(std::filesystem::path path, std::string command_line, Missing missing, Access access = Access::alone);
  ~ResultDirectory();
  ResultDirectory(const ResultDirectory &) = delete;
  ResultDirectory &operator=(const ResultDirectory &) = delete;

  const std::filesystem::path &path() const { return path_; }
  const Manifest &manifest() const { return manifest_; }
  bool has(const std::string &file) const { return std::filesystem::is_regular_file(path_ / file); }

  /// Run the stage unless code, options and the content of its inputs are those of the outputs that are there. Throws
  /// InputError for an input that is missing, changed since it was made, or made from other files than those there now;
  /// what the stage throws otherwise. Returns the stage's notes.
  Notes run(const Stage &stage);

  /// Digests of files that a stage reads. Throws InputError as run() does for its inputs.
  FileDigests current(const std::vector<std::string> &files);

private:
  void require_current(const std::string &file);
  bool is_up_to_date(const Stage &stage, const std::string &key);
  /// The stage's outputs from another directory, with their record; nothing when that has none with this key, or
  /// another process writes there.
  std::optional<StageRecord> take_from(const std::filesystem::path &other, const Stage &stage, const std::string &key);
  void keep(const std::string &stage, const StageRecord &record);
  const std::string &digest(const std::string &file);

  std::filesystem::path path_;
  std::string command_line_;
  std::vector<std::filesystem::path> created_; ///< directories that this object made, outermost first
  int lock_ = -1;
  Manifest manifest_;
  FileDigests known_digests_; ///< of files read or made by this process
};
} // namespace pelvireg::cli
