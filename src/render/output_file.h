#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace boxwood {

/// A file that appears under its name only once it is complete: bytes go to a temporary file beside it, which commit()
/// renames. Without commit() nothing is left behind. All members throw Error naming the file and the cause.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::span<const std::byte> bytes);
  /// Flushes to the disk and renames; nothing may be written afterwards.
  void commit();

 private:
  [[noreturn]] void fail(int cause) const;

  std::filesystem::path file_, temporary_;
  int descriptor_ = -1;
};

}  // namespace boxwood
