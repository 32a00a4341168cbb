#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace boxwood {

/// The bytes of a file one after another, in constant memory. Files compressed by gzip are unpacked on the way. Throws
/// Error naming the file when it cannot be read or is damaged.
class ByteStream {
 public:
  explicit ByteStream(const std::filesystem::path& file);
  ~ByteStream();
  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;

  static constexpr int end = -1;
  /// The next byte, 0 … 255, without taking it; `end` after the last.
  int peek() { return position_ < size_ || refill() ? static_cast<unsigned char>(buffer_[position_]) : end; }
  void take() { ++position_; }
  const std::string& name() const { return name_; }

 private:
  bool refill();
  void* handle_;  // zlib's
  std::string name_;
  std::vector<char> buffer_;
  std::size_t position_ = 0, size_ = 0;
};

bool is_gzip_name(const std::filesystem::path& file);

/// The unpacked bytes of a .gz file. Throws Error naming the file when it cannot be read, is damaged or incomplete, or
/// unpacks to more than 100 times its size and 16 MiB, which meshes do not.
std::string read_gzip_file(const std::filesystem::path& file);

}  // namespace boxwood
