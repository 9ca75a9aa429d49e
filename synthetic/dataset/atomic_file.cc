#include "synthetic/dataset/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <stdexcept>
#include <string>
#include <unistd.h>

namespace pelvireg::dataset
{
namespace
{
[[noreturn]] void refuse(const std::string &what, const std::filesystem::path &path)
{
  throw std::runtime_error("cannot " + what + " '" + path.string() + "': " + std::strerror(errno));
}

void synchronise(const std::filesystem::path &path, int flags)
{
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC);
  if (descriptor < 0)
    refuse("open", path);
  const bool ok = ::fsync(descriptor) == 0;
  ::close(descriptor);
  if (!ok)
    refuse("write", path);
}

std::filesystem::path directory_of(const std::filesystem::path &path)
{
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}
} // namespace

AtomicFile::AtomicFile(std::filesystem::path target)
    : target_(std::move(target)), temporary_path_(target_.string() + "." + std::to_string(::getpid()) + ".tmp")
{
}

AtomicFile::~AtomicFile()
{
  std::error_code ignored;
  if (!is_published_)
    std::filesystem::remove(temporary_path_, ignored);
}

void AtomicFile::publish()
{
  synchronise(temporary_path_, O_RDWR);
  if (::rename(temporary_path_.c_str(), target_.c_str()) != 0)
    refuse("write", target_);
  is_published_ = true;
  synchronise(directory_of(target_), O_RDONLY | O_DIRECTORY);
}

void write_text_file(const std::filesystem::path &file, std::string_view text)
{
  AtomicFile pending(file);
  std::ofstream out(pending.temporary_path(), std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out)
    refuse("write", file);
  pending.publish();
}
} // namespace pelvireg::dataset
