// Layout of an entry, little endian: magic, version, then the sources (path, size, time), then the scene's fields in
// order, each array as a 64-bit length and its elements, then a checksum of everything before it.
#include "scene/mesh_cache.h"

#include <fmt/format.h>

#include <bit>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <type_traits>

#include "files/output_file.h"
#include "math/random.h"
#include "scene/placement.h"

namespace boxwood {
namespace {

namespace fs = std::filesystem;

/// Raise the number when importers or this layout change what a file becomes. The order of its bytes marks endianness.
constexpr std::uint64_t magic = 0x0004'6568'6361'6378u;

/// Order-sensitive checksum of blocks, eight bytes at a time.
class Checksum {
 public:
  void add(const void* data, std::size_t size) {
    const char* at = static_cast<const char*>(data);
    for (; size >= 8; at += 8, size -= 8) add_word(at, 8);
    if (size > 0) add_word(at, size);
  }
  std::uint64_t value() const { return mix_bits(state_); }

 private:
  void add_word(const char* at, std::size_t size) {
    std::uint64_t word = size;
    std::memcpy(&word, at, size);
    state_ = (std::rotl(state_, 23) ^ word) * 0x9e3779b97f4a7c15u;
  }
  std::uint64_t state_ = 0x6a09e667f3bcc909u;
};

/// Writes values and arrays of plain data.
class Writer {
 public:
  explicit Writer(OutputFile& out) : out_(out) {}

  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    raw(&v, sizeof(v));
  }
  template <class Array>
  void array(const Array& elements) {
    static_assert(std::is_trivially_copyable_v<typename Array::value_type>);
    value(std::uint64_t{elements.size()});
    raw(elements.data(), elements.size() * sizeof(typename Array::value_type));
  }
  template <class T, class Write>
  void list(const std::vector<T>& elements, const Write& write) {
    value(std::uint64_t{elements.size()});
    for (const T& element : elements) write(element);
  }
  void finish() { value(checksum_.value()); }

 private:
  void raw(const void* data, std::size_t size) {
    out_.write({static_cast<const std::byte*>(data), size});
    checksum_.add(data, size);
  }
  OutputFile& out_;
  Checksum checksum_;
};

struct Damaged {};

/// Its mirror image. Throws Damaged rather than taking more memory than the file can fill.
class Reader {
 public:
  explicit Reader(const fs::path& file) : in_(file, std::ios::binary) {
    std::error_code error;
    left_ = fs::file_size(file, error);
    if (!in_ || error) throw Damaged();
  }

  template <class T>
  void value(T& v) {
    raw(&v, sizeof(v));
  }
  template <class Array>
  void array(Array& elements) {
    elements.resize(length(sizeof(typename Array::value_type)));
    raw(elements.data(), elements.size() * sizeof(typename Array::value_type));
  }
  template <class T, class Read>
  void list(std::vector<T>& elements, const Read& read) {
    for (std::uint64_t count = length(1); count > 0; --count) read(elements.emplace_back());
  }
  void finish() {
    const std::uint64_t expected = checksum_.value();
    std::uint64_t stored = 0;
    value(stored);
    if (stored != expected || left_ != 0) throw Damaged();
  }

 private:
  std::uint64_t length(std::size_t element_size) {
    std::uint64_t count = 0;
    value(count);
    if (count > left_ / element_size) throw Damaged();
    return count;
  }
  void raw(void* data, std::size_t size) {
    if (size > left_) throw Damaged();
    if (size == 0) return;
    in_.read(static_cast<char*>(data), static_cast<std::streamsize>(size));
    if (!in_) throw Damaged();
    left_ -= size;
    checksum_.add(data, size);
  }
  std::ifstream in_;
  std::uint64_t left_ = 0;
  Checksum checksum_;
};

/// The fields of a scene in order, for a Writer and a const Scene or a Reader and a Scene.
template <class Stream, class S>
void transfer(Stream& stream, S& scene) {
  stream.array(scene.name);
  stream.list(scene.meshes, [&](auto& mesh) {
    stream.array(mesh.name);
    stream.array(mesh.positions);
    stream.array(mesh.triangles);
    stream.array(mesh.materials);
    stream.array(mesh.normals);
    stream.array(mesh.texture_coordinates);
  });
  stream.array(scene.instances);
  stream.list(scene.materials, [&](auto& material) {
    stream.array(material.name);
    for (auto* color :
         {&material.diffuse, &material.emission, &material.specular, &material.reflection, &material.transmission}) {
      stream.value(*color);
    }
    for (auto* number : {&material.shininess, &material.refraction_index}) stream.value(*number);
    stream.value(material.emits_behind);
    stream.value(material.texture);
  });
  // Of textures that have files these are read each time.
  stream.list(scene.textures, [&](auto& texture) {
    stream.array(texture.file);
    for (auto* pixels : {&texture.width, &texture.height}) stream.value(*pixels);
    stream.array(texture.pixels);
  });
  stream.list(scene.cameras, [&](auto& camera) {
    stream.array(camera.name);
    for (auto* vector : {&camera.eye, &camera.direction, &camera.up}) stream.value(*vector);
    stream.value(camera.fov);
    stream.value(camera.mirrored);
    for (auto* pixels : {&camera.width, &camera.height}) stream.value(*pixels);
  });
  stream.array(scene.lights);
  stream.value(scene.notes.degenerate_triangles);
  stream.value(scene.notes.non_finite_triangles);
  stream.list(scene.notes.messages, [&](auto& message) { stream.array(message); });
}

constexpr std::uint64_t no_size = ~std::uint64_t{0};

/// A file as it was when a scene was made from it.
struct Source {
  std::string path;
  std::uint64_t size = 0;
  std::int64_t time = 0;
  friend bool operator==(const Source&, const Source&) = default;
};

/// A file that was looked for in vain must still be missing.
Source describe(const fs::path& file) {
  const fs::path absolute = fs::absolute(file).lexically_normal();
  if (!fs::exists(absolute)) return {absolute.string(), no_size, 0};
  return {absolute.string(), fs::file_size(absolute),
          static_cast<std::int64_t>(fs::last_write_time(absolute).time_since_epoch().count())};
}

template <class Stream, class S>
void transfer_source(Stream& stream, S& source) {
  stream.array(source.path);
  stream.value(source.size);
  stream.value(source.time);
}

fs::path cache_folder() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string(value ? value : "");
  };
  if (const std::string own = variable("BOXWOOD_CACHE"); !own.empty()) return own == "off" ? "" : own;
  if (const std::string shared = variable("XDG_CACHE_HOME"); !shared.empty()) return fs::path(shared) / "boxwood";
  if (const std::string home = variable("HOME"); !home.empty()) return fs::path(home) / ".cache" / "boxwood";
  return {};
}

}  // namespace

fs::path cache_entry(const fs::path& file) {
  const fs::path folder = cache_folder();
  if (folder.empty()) return {};
  const std::string path = fs::absolute(file).lexically_normal().string();
  Checksum name;
  name.add(path.data(), path.size());
  return folder / fmt::format("{}-{:016x}.mesh", file.stem().string(), name.value());
}

std::optional<Scene> read_cached(const fs::path& file) try {
  const fs::path entry = cache_entry(file);
  if (entry.empty() || !fs::is_regular_file(entry)) return std::nullopt;
  Reader reader(entry);
  std::uint64_t mark = 0;
  reader.value(mark);
  if (mark != magic) return std::nullopt;
  std::vector<Source> sources;
  reader.list(sources, [&](Source& source) { transfer_source(reader, source); });
  if (sources.empty() || sources.front() != describe(file)) return std::nullopt;
  for (const Source& source : sources) {
    if (source != describe(source.path)) return std::nullopt;
  }
  Scene scene;
  transfer(reader, scene);
  reader.finish();
  if (!find_bad_index(scene).empty()) return std::nullopt;
  return scene;
} catch (const Damaged&) {
  return std::nullopt;
} catch (const fs::filesystem_error&) {
  return std::nullopt;
}

void write_cached(const Scene& scene, std::span<const fs::path> sources) try {
  const fs::path entry = cache_entry(sources.front());
  if (entry.empty()) return;
  std::vector<Source> described;
  for (const fs::path& source : sources) described.push_back(describe(source));
  fs::create_directories(entry.parent_path());
  OutputFile out(entry);
  Writer writer(out);
  writer.value(magic);
  writer.list(described, [&](const Source& source) { transfer_source(writer, source); });
  transfer(writer, scene);
  writer.finish();
  out.commit();
} catch (const fs::filesystem_error&) {
  // No place to write: the scene is imported again next time.
} catch (const Error&) {
}

}  // namespace boxwood
