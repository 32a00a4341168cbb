#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

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
  void write(std::string_view text) { write(std::as_bytes(std::span(text))); }
  /// Flushes to the disk and renames; nothing may be written afterwards.
  void commit();

 private:
  void write_through(std::span<const std::byte> bytes);
  [[noreturn]] void fail(int cause) const;

  std::filesystem::path file_, temporary_;
  int descriptor_ = -1;
  std::vector<std::byte> buffer_;  ///< small writes, gathered
};

}  // namespace boxwood
