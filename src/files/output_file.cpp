#include "files/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "boxwood/error.h"

namespace boxwood {
namespace {

constexpr std::size_t buffer_size = 1 << 16;

/// Unique among processes and threads; in the same folder, so that renaming stays within one file system.
std::filesystem::path temporary_name(const std::filesystem::path& file) {
  static std::atomic<unsigned> serial{0};
  std::filesystem::path name = file;
  name += fmt::format(".partial-{}-{}", getpid(), serial++);
  return name;
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path file) : file_(std::move(file)), temporary_(temporary_name(file_)) {
  if (std::filesystem::is_directory(file_)) fail(EISDIR);
  descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(errno);
}

OutputFile::~OutputFile() {
  if (descriptor_ < 0) return;
  close(descriptor_);
  unlink(temporary_.c_str());
}

void OutputFile::write(std::span<const std::byte> bytes) {
  if (buffer_.size() + bytes.size() > buffer_size) {
    write_through(buffer_);
    buffer_.clear();
  }
  if (bytes.size() > buffer_size) {
    write_through(bytes);
  } else {
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  }
}

void OutputFile::write_through(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), std::min<std::size_t>(bytes.size(), 1u << 30));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(written < 0 ? errno : ENOSPC);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void OutputFile::commit() {
  write_through(buffer_);
  // EINVAL: the file system knows no syncing.
  if (fsync(descriptor_) != 0 && errno != EINVAL) fail(errno);
  if (std::rename(temporary_.c_str(), file_.c_str()) != 0) fail(errno);
  if (close(std::exchange(descriptor_, -1)) != 0) fail(errno);
}

void OutputFile::fail(int cause) const {
  throw Error(fmt::format("cannot write '{}': {}; choose another place or free some space", file_.string(),
                          std::generic_category().message(cause)));
}

}  // namespace boxwood
