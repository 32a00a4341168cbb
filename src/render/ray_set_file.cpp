// Ray sets on disk. The format is described byte by byte in docs/ray-sets.md.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "boxwood/ray_set.h"
#include "files/output_file.h"

namespace boxwood {
namespace {

static_assert(std::endian::native == std::endian::little,
              "files are little-endian; swap bytes here for other machines");

constexpr std::array<char, 8> magic = {'B', 'O', 'X', 'W', 'R', 'A', 'Y', 'S'};
constexpr std::uint32_t current_version = 1;
constexpr std::uint64_t longest_kind = 64;
constexpr std::size_t alignment = 16;

struct FileHeader {
  std::array<char, 8> magic;
  std::uint32_t version;
  std::uint32_t sets;
};
static_assert(sizeof(FileHeader) == 16);

struct SetHeader {
  std::uint32_t kind_length;
  std::uint32_t query;
  std::uint64_t rays;
};
static_assert(sizeof(SetHeader) == 16);

using Checksum = std::uint64_t;

/// FNV-1a, 64 bits (Fowler, Noll, Vo). Every step is a bijection, so no single changed byte goes unseen.
Checksum checksum(std::span<const std::byte> bytes, Checksum hash) {
  for (const std::byte byte : bytes) hash = (hash ^ static_cast<std::uint64_t>(byte)) * 0x100000001b3u;
  return hash;
}
constexpr Checksum empty_checksum = 0xcbf29ce484222325u;

constexpr std::size_t padded(std::size_t size) { return (size + alignment - 1) / alignment * alignment; }

bool is_kind(std::string_view kind) {
  return !kind.empty() && kind.size() <= longest_kind &&
         std::ranges::all_of(kind, [](unsigned char c) { return c > ' ' && c < 127; });
}

class Writer {
 public:
  explicit Writer(const std::filesystem::path& file) : out_(file) {}

  void write(std::span<const std::byte> bytes) {
    checksum_ = checksum(bytes, checksum_);
    out_.write(bytes);
  }
  template <class T>
  void write_object(const T& object) {
    write(std::as_bytes(std::span(&object, 1)));
  }
  void finish() {
    const Checksum sum = checksum_;
    out_.write(std::as_bytes(std::span(&sum, 1)));
    out_.commit();
  }

 private:
  OutputFile out_;
  Checksum checksum_ = empty_checksum;
};

/// Never reads, and never promises, more than the file has.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : name_(file.string()), in_(file, std::ios::binary) {
    std::error_code error;
    left_ = std::filesystem::file_size(file, error);
    if (error) throw Error(fmt::format("cannot read '{}': {}", name_, error.message()));
    if (!in_) throw Error(fmt::format("cannot read '{}': {}", name_, std::generic_category().message(errno)));
  }

  std::uint64_t left() const { return left_; }
  std::uint64_t offset() const { return offset_; }
  Checksum sum() const { return checksum_; }

  void read(std::span<std::byte> bytes, std::string_view what) {
    if (bytes.size() > left_) fail(fmt::format("it ends within {} at byte {}", what, offset_ + left_));
    in_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!in_) throw Error(fmt::format("cannot read '{}' beyond byte {}", name_, offset_));
    checksum_ = checksum(bytes, checksum_);
    left_ -= bytes.size();
    offset_ += bytes.size();
  }
  template <class T>
  T read_object(std::string_view what) {
    T object;
    read(std::as_writable_bytes(std::span(&object, 1)), what);
    return object;
  }

  [[noreturn]] void fail(std::string_view problem) const {
    throw Error(fmt::format("'{}' is not a usable ray set file: {}; make it anew", name_, problem));
  }

 private:
  std::string name_;
  std::ifstream in_;
  std::uint64_t left_ = 0, offset_ = 0;
  Checksum checksum_ = empty_checksum;
};

RaySet read_set(Reader& reader) {
  const std::uint64_t start = reader.offset();
  const auto header = reader.read_object<SetHeader>("the header of a set");
  if (header.kind_length == 0 || header.kind_length > longest_kind) {
    reader.fail(fmt::format("the kind of the set at byte {} is {} characters long, not 1 to {}", start,
                            header.kind_length, longest_kind));
  }
  if (header.query > static_cast<std::uint32_t>(Query::any_hit)) {
    reader.fail(fmt::format("the set at byte {} has query {}, which is none", start, header.query));
  }
  std::string kind(padded(header.kind_length), '\0');
  reader.read(std::as_writable_bytes(std::span(kind)), "the name of a kind");
  if (kind.find_first_not_of('\0', header.kind_length) != std::string::npos ||
      !is_kind(kind.substr(0, header.kind_length))) {
    reader.fail(fmt::format("the set at byte {} has a kind that is not text", start));
  }
  kind.resize(header.kind_length);

  if (header.rays > reader.left() / sizeof(Ray)) {
    reader.fail(fmt::format("the set '{}' at byte {} is said to have {} rays, more than the file holds", kind, start,
                            header.rays));
  }
  RaySet set{std::move(kind), static_cast<Query>(header.query), std::vector<Ray>(header.rays)};
  reader.read(std::as_writable_bytes(std::span(set.rays)), "a ray");
  return set;
}

}  // namespace

void save_ray_sets(const std::filesystem::path& file, std::span<const RaySet> sets) {
  for (const RaySet& set : sets) {
    if (!is_kind(set.kind)) {
      throw UsageError(
          fmt::format("'{}' can not name a kind of rays; use 1 to {} printable ASCII characters without blanks",
                      set.kind, longest_kind));
    }
  }
  Writer writer(file);
  writer.write_object(FileHeader{magic, current_version, static_cast<std::uint32_t>(sets.size())});
  for (const RaySet& set : sets) {
    writer.write_object(
        SetHeader{static_cast<std::uint32_t>(set.kind.size()), static_cast<std::uint32_t>(set.query), set.rays.size()});
    std::string kind = set.kind;
    kind.resize(padded(kind.size()), '\0');
    writer.write(std::as_bytes(std::span(kind)));
    writer.write(std::as_bytes(std::span(set.rays)));
  }
  writer.finish();
}

std::vector<RaySet> load_ray_sets(const std::filesystem::path& file) {
  Reader reader(file);
  const auto header = reader.read_object<FileHeader>("its header");
  if (header.magic != magic) reader.fail("it does not begin with BOXWRAYS");
  if (header.version != current_version) {
    reader.fail(fmt::format("it has version {}; this program reads version {}", header.version, current_version));
  }
  std::vector<RaySet> sets;
  for (std::uint32_t i = 0; i < header.sets; ++i) sets.push_back(read_set(reader));
  const Checksum expected = reader.sum();
  if (reader.read_object<Checksum>("its checksum") != expected) reader.fail("its checksum does not match");
  if (reader.left() != 0) reader.fail(fmt::format("{} bytes follow its checksum", reader.left()));
  return sets;
}

}  // namespace boxwood
