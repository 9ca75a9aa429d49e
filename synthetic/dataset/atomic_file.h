// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace pelvireg::dataset
{
/// A file being written under a temporary name beside its target. publish() makes it durable and gives it its name;
/// without publish() the destructor removes it, so that nothing half-written stays.
class AtomicFile
{
public:
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile &) = delete;
  AtomicFile &operator=(const AtomicFile &) = delete;

  /// Where to write until publish() is called.
  const std::filesystem::path &temporary_path() const { return temporary_path_; }

  /// fsync, rename, fsync of the directory. Throws std::runtime_error when the disk refuses.
  void publish();

private:
  std::filesystem::path target_;
  std::filesystem::path temporary_path_;
  bool is_published_ = false;
};

/// Write a whole text file (CSV, JSON, HTML) so that readers see the old content or the new one, never a part.
/// Throws std::runtime_error when the disk refuses.
void write_text_file(const std::filesystem::path &file, std::string_view text);
} // namespace pelvireg::dataset
