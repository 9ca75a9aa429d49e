#include "validation/cli/stage_cache.h"

#include "synthetic/dataset/atomic_file.h"
#include "synthetic/dataset/error.h"
#include "validation/cli/sha256.h"
#include "validation/cli/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <fcntl.h>
#include <iterator>
#include <sys/file.h>
#include <unistd.h>

namespace pelvireg::cli
{
namespace
{
/// What an earlier process that was killed left half-written. Safe: the directory is locked.
void remove_leftovers(const std::filesystem::path &directory)
{
  for (const auto &entry : std::filesystem::directory_iterator(directory))
    if (entry.is_regular_file() && entry.path().extension().string().rfind(".tmp", 0) == 0)
      std::filesystem::remove(entry.path());
    else if (entry.is_directory() && entry.path().filename().string().rfind("parts-", 0) == 0)
      remove_leftovers(entry.path());
}

/// Make a directory and its missing parents; those that were missing, outermost first.
std::vector<std::filesystem::path> make_missing_directories(const std::filesystem::path &path)
{
  std::vector<std::filesystem::path> missing;
  for (std::filesystem::path p = path; !p.empty() && !std::filesystem::exists(p); p = p.parent_path())
    missing.insert(missing.begin(), p);
  for (const std::filesystem::path &directory : missing)
  {
    std::error_code error;
    std::filesystem::create_directory(directory, error);
    if (error)
      throw InputError(fmt::format("result directory '{}' cannot be made ({}); give another one with --out",
                                   path.string(), error.message()));
  }
  return missing;
}

std::string key_of(const Stage &stage, const FileDigests &inputs)
{
  std::string text = stage.name + "\n" + build() + "\n" + stage.options + "\n";
  for (const std::string &folder : stage.code)
    text += folder + " " + source_digest(folder) + "\n";
  for (const auto &[file, digest] : inputs)
    text += file + " " + digest + "\n";
  return sha256_of_text(text);
}
} // namespace

ResultDirectory::ResultDirectory(std::filesystem::path path, std::string command_line, Missing missing, Access access)
    : path_(std::move(path)), command_line_(std::move(command_line))
{
  if (missing == Missing::create)
    created_ = make_missing_directories(path_);
  lock_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0)
    throw InputError(fmt::format("result directory '{}' does not exist; make it with 'pelvireg anatomy CASE --out {}'",
                                 path_.string(), path_.string()));
  if (::flock(lock_, (access == Access::alone ? LOCK_EX : LOCK_SH) | LOCK_NB) != 0)
  {
    ::close(lock_);
    throw InputError(fmt::format("result directory '{}' is in use by another pelvireg; wait for it or give another one",
                                 path_.string()));
  }
  if (access == Access::alone)
    remove_leftovers(path_);
  manifest_ = load_manifest(path_);
}

ResultDirectory::~ResultDirectory()
{
  ::close(lock_);
  // Removes empty directories only, which is what is wanted.
  std::error_code ignored;
  for (auto directory = created_.rbegin(); directory != created_.rend(); ++directory)
    std::filesystem::remove(*directory, ignored);
}

const std::string &ResultDirectory::digest(const std::string &file)
{
  auto known = known_digests_.find(file);
  if (known == known_digests_.end())
    known = known_digests_.emplace(file, sha256_of_file(path_ / file)).first;
  return known->second;
}

/// A file must be what its stage wrote, from the inputs that are there now, and these in turn.
void ResultDirectory::require_current(const std::string &file)
{
  std::string stage;
  const StageRecord *maker = manifest_.maker_of(file, &stage);
  if (!has(file))
    throw InputError(fmt::format("'{}' does not exist; run the stage that makes it first", (path_ / file).string()));
  if (!maker)
    return;
  if (digest(file) != maker->outputs.at(file))
    throw InputError(fmt::format("'{}' is not what stage '{}' wrote (damaged or changed by hand); run that stage again",
                                 (path_ / file).string(), stage));
  for (const auto &[input, former_digest] : maker->inputs)
  {
    require_current(input);
    if (digest(input) != former_digest)
      throw InputError(fmt::format("'{}' was made from another {} than the one there is now; run stage '{}' again",
                                   (path_ / file).string(), input, stage));
  }
}

FileDigests ResultDirectory::current(const std::vector<std::string> &files)
{
  FileDigests digests;
  for (const std::string &file : files)
  {
    require_current(file);
    digests[file] = digest(file);
  }
  return digests;
}

bool ResultDirectory::is_up_to_date(const Stage &stage, const std::string &key)
{
  const auto former = manifest_.stages.find(stage.name);
  if (former == manifest_.stages.end() || former->second.key != key)
    return false;
  for (const std::string &output : stage.outputs)
    if (!has(output) || !former->second.outputs.contains(output) || digest(output) != former->second.outputs.at(output))
      return false;
  return true;
}

std::optional<StageRecord> ResultDirectory::take_from(const std::filesystem::path &other, const Stage &stage,
                                                      const std::string &key)
{
  if (!std::filesystem::is_directory(other))
    return std::nullopt;
  try
  {
    ResultDirectory source(other, "", Missing::refuse, Access::shared);
    if (!source.is_up_to_date(stage, key))
      return std::nullopt;
    StageRecord record = source.manifest_.stages.at(stage.name);
    record.outputs.clear();
    for (const std::string &output : stage.outputs)
    {
      dataset::AtomicFile copy(path_ / output);
      std::filesystem::copy_file(other / output, copy.temporary_path(),
                                 std::filesystem::copy_options::overwrite_existing);
      copy.publish();
      record.outputs[output] = known_digests_[output] = source.digest(output);
    }
    return record;
  }
  catch (const InputError &)
  {
    return std::nullopt; // in use, or damaged: the stage is run here
  }
}

void ResultDirectory::keep(const std::string &stage, const StageRecord &record)
{
  for (const auto &[output, digest] : record.outputs)
    manifest_.forget(output);
  manifest_.stages[stage] = record;
  save_manifest(manifest_, path_);
}

Notes ResultDirectory::run(const Stage &stage)
{
  StageRecord record;
  record.inputs = current(stage.inputs);
  record.key = key_of(stage, record.inputs);
  if (is_up_to_date(stage, record.key))
  {
    fmt::print("{}: up to date\n", stage.name);
    return manifest_.stages.at(stage.name).notes;
  }
  for (const std::filesystem::path &other : stage.elsewhere)
    if (const std::optional<StageRecord> taken = take_from(other, stage, record.key))
    {
      keep(stage.name, *taken);
      fmt::print("{}: taken from {}\n", stage.name, other.string());
      return taken->notes;
    }
  Progress progress(stage.name);
  record.notes = stage.work(progress);
  std::vector<std::string> outputs = stage.outputs;
  std::copy_if(stage.optional_outputs.begin(), stage.optional_outputs.end(), std::back_inserter(outputs),
               [&](const std::string &output) { return has(output); });
  for (const std::string &output : outputs)
  {
    known_digests_.erase(output);
    record.outputs[output] = digest(output);
  }
  record.seconds = progress.seconds();
  record.command_line = command_line_;
  record.revision = revision();
  keep(stage.name, record);
  progress.finish("done");
  return record.notes;
}
} // namespace pelvireg::cli
