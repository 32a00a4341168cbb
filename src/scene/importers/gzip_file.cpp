#include "scene/importers/gzip_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <memory>

#include "boxwood/error.h"

namespace boxwood {
namespace {

gzFile open(const std::filesystem::path& file) {
  std::error_code ignored;
  gzFile handle = std::filesystem::is_directory(file, ignored) ? nullptr : gzopen(file.c_str(), "rb");
  if (!handle) {
    throw Error(fmt::format("{}: cannot be opened for reading; check its permissions", file.string()));
  }
  return handle;
}

/// Bytes read into `buffer`, less than its size only at the end.
std::size_t read(gzFile handle, char* buffer, std::size_t size, const std::string& name) {
  const int count = gzread(handle, buffer, static_cast<unsigned>(size));
  int code = Z_OK;
  gzerror(handle, &code);
  if (count < 0 || (code != Z_OK && code != Z_STREAM_END)) {
    throw Error(fmt::format("{}: is damaged or incomplete and cannot be unpacked; get it again", name));
  }
  return static_cast<std::size_t>(count);
}

}  // namespace

ByteStream::ByteStream(const std::filesystem::path& file)
    : handle_(open(file)), name_(file.string()), buffer_(1 << 16) {}

ByteStream::~ByteStream() { gzclose_r(static_cast<gzFile>(handle_)); }

bool ByteStream::refill() {
  position_ = 0;
  size_ = read(static_cast<gzFile>(handle_), buffer_.data(), buffer_.size(), name_);
  return size_ > 0;
}

bool is_gzip_name(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".gz" || extension == ".GZ";
}

std::string read_gzip_file(const std::filesystem::path& file) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> handle(open(file), gzclose_r);
  std::error_code error;
  const std::uintmax_t packed = std::filesystem::file_size(file, error);
  const std::uintmax_t most = (error ? 0 : packed * 100) + (std::uintmax_t{16} << 20);
  constexpr std::size_t step = std::size_t{1} << 20;
  std::string bytes;
  for (std::size_t got = step; got == step;) {
    const std::size_t size = bytes.size();
    bytes.resize(size + step);
    got = read(handle.get(), bytes.data() + size, step, file.string());
    bytes.resize(size + got);
    if (bytes.size() > most) {
      throw Error(fmt::format("{}: unpacks to more than 100 times its {} bytes, so it is no mesh; check what it is",
                              file.string(), packed));
    }
  }
  return bytes;
}

}  // namespace boxwood
