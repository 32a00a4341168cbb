// PLY meshes: positions, normals, texture coordinates and faces; everything else in the file is passed over.
#include <fmt/format.h>

#include <array>
#include <limits>
#include <optional>

#include "scene/importers/gzip_file.h"
#include "scene/importers/importer.h"
#include "scene/importers/ply_header.h"
#include "scene/importers/ply_values.h"
#include "scene/importers/polygon.h"
#include "scene/importers/repeated_note.h"

namespace boxwood {
namespace {

/// Where the values of a vertex go: a slot 0…7 (x y z nx ny nz u v) per property; no_slot is passed over.
constexpr std::size_t no_slot = 8;

std::size_t slot_of(std::string_view property) {
  constexpr std::array<std::array<std::string_view, 3>, 8> names = {{{"x", "x", "x"},
                                                                     {"y", "y", "y"},
                                                                     {"z", "z", "z"},
                                                                     {"nx", "nx", "nx"},
                                                                     {"ny", "ny", "ny"},
                                                                     {"nz", "nz", "nz"},
                                                                     {"u", "s", "texture_u"},
                                                                     {"v", "t", "texture_v"}}};
  for (std::size_t slot = 0; slot < names.size(); ++slot) {
    for (const std::string_view name : names[slot]) {
      if (property == name) return slot;
    }
  }
  return no_slot;
}

template <class Values>
class PlyReader {
 public:
  PlyReader(Values values, std::string file) : values_(std::move(values)), file_(std::move(file)) {}

  Mesh read(const PlyHeader& header, std::vector<std::string>& messages) {
    for (const PlyElement& element : header.elements) {
      check_count(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else {
        for (std::uint64_t i = 0; i < element.count; ++i, check_end(element, i)) pass_over(element.properties);
      }
    }
    out_of_range_.report(messages);
    too_short_.report(messages);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(std::string_view what) const { throw Error(fmt::format("{}: {}", file_, what)); }

  void check_count(const PlyElement& element) const {
    if (element.properties.empty()) {
      if (element.count > 0)
        fail(fmt::format("the element '{}' has no properties; the header is broken", element.name));
      return;
    }
    const PlyProperty& first = element.properties.front();
    if (!values_.can_hold(element.count, first.is_list ? first.count_type : first.type)) {
      fail(fmt::format("the header promises {} of '{}', more than the file can hold; it is incomplete, get it again",
                       element.count, element.name));
    }
  }

  void check_end(const PlyElement& element, std::uint64_t done) const {
    if (!values_.ended()) return;
    fail(fmt::format("ends after {} of {} of '{}'; the file is incomplete, get it again", done - 1, element.count,
                     element.name));
  }

  std::uint64_t list_length(const PlyProperty& list) {
    const double length = values_.read(list.count_type);
    if (values_.ended()) return 0;
    if (!(length >= 0 && length < 0x1p32) || !values_.can_hold(static_cast<std::uint64_t>(length), list.type)) {
      throw Error(fmt::format("{}: a list '{}' of length {} does not fit the file; the file is damaged, get it again",
                              values_.place(), list.name, length));
    }
    return static_cast<std::uint64_t>(length);
  }

  void pass_over(const PlyProperty& property) {
    if (!property.is_list) {
      values_.read(property.type);
      return;
    }
    const std::uint64_t length = list_length(property);
    for (std::uint64_t i = 0; i < length; ++i) values_.read(property.type);
  }

  void pass_over(const std::vector<PlyProperty>& properties) {
    for (const PlyProperty& property : properties) pass_over(property);
  }

  void read_vertices(const PlyElement& element) {
    if (element.count >= no_primitive_count) fail("has more than 2^32 - 2 vertices; split it");
    std::vector<std::size_t> slots;
    std::array<bool, no_slot + 1> present{};
    for (const PlyProperty& property : element.properties) {
      slots.push_back(property.is_list ? no_slot : slot_of(property.name));
      present[slots.back()] = true;
    }
    if (!(present[0] && present[1] && present[2])) fail("its vertices lack x, y or z; add the property");
    const bool normals = present[3] && present[4] && present[5], texture = present[6] && present[7];
    mesh_.positions.reserve(element.count);
    if (normals) mesh_.normals.reserve(element.count);
    if (texture) mesh_.texture_coordinates.reserve(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i, check_end(element, i)) {
      std::array<float, no_slot> at{};
      for (std::size_t p = 0; p < slots.size(); ++p) {
        if (slots[p] == no_slot) {
          pass_over(element.properties[p]);
        } else {
          at[slots[p]] = to_float(values_.read(element.properties[p].type));
        }
      }
      mesh_.positions.push_back({at[0], at[1], at[2]});
      if (normals) mesh_.normals.push_back({at[3], at[4], at[5]});
      if (texture) mesh_.texture_coordinates.push_back({at[6], at[7]});
    }
  }

  void read_faces(const PlyElement& element) {
    if (mesh_.positions.empty() && element.count > 0) fail("has faces before its vertices, or no vertices; reorder it");
    bool has_corners = false;
    for (const PlyProperty& property : element.properties) has_corners |= is_corner_list(property);
    if (!has_corners) fail("its faces lack the list 'vertex_indices'; add the property");
    mesh_.triangles.reserve(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i, check_end(element, i)) {
      for (const PlyProperty& property : element.properties) {
        is_corner_list(property) ? read_corners(property) : pass_over(property);
      }
      if (mesh_.triangles.size() >= no_primitive_count) fail("has more than 2^32 - 2 triangles; split it");
    }
  }

  static bool is_corner_list(const PlyProperty& property) {
    return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
  }

  void read_corners(const PlyProperty& list) {
    const std::uint64_t length = list_length(list);
    corners_.clear();
    std::optional<double> bad;
    for (std::uint64_t i = 0; i < length; ++i) {
      const double index = values_.read(list.type);
      const bool fits = index >= 0 && index < static_cast<double>(mesh_.positions.size());
      if (!fits && !bad) bad = index;
      corners_.push_back(fits ? static_cast<std::uint32_t>(index) : 0);
    }
    if (values_.ended()) return;
    if (bad) {
      return out_of_range_.add([&] {
        return fmt::format("{}: face refers to vertex {} of {}; the face was skipped", values_.place(), *bad,
                           mesh_.positions.size());
      });
    }
    if (length < 3) {
      return too_short_.add(
          [&] { return fmt::format("{}: face has {} corners; it was skipped", values_.place(), length); });
    }
    append_polygon();
  }

  void append_polygon() {
    if (corners_.size() == 3) {
      mesh_.triangles.push_back({corners_[0], corners_[1], corners_[2]});
      return;
    }
    polygon_.clear();
    cut_.clear();
    for (const std::uint32_t corner : corners_) polygon_.push_back(mesh_.positions[corner]);
    triangulate_polygon(polygon_, cut_);
    for (const Triangle& t : cut_) mesh_.triangles.push_back({corners_[t[0]], corners_[t[1]], corners_[t[2]]});
  }

  /// A double that a float cannot hold becomes infinite, and is then counted as not finite.
  static float to_float(double value) {
    constexpr double largest = std::numeric_limits<float>::max();
    if (value > largest) return std::numeric_limits<float>::infinity();
    if (value < -largest) return -std::numeric_limits<float>::infinity();
    return static_cast<float>(value);
  }

  static constexpr std::uint64_t no_primitive_count = 0xffffffffu;
  Values values_;
  std::string file_;
  Mesh mesh_;
  std::vector<std::uint32_t> corners_;
  std::vector<Vec3> polygon_;
  std::vector<Triangle> cut_;
  RepeatedNote out_of_range_, too_short_;
};

template <class Values>
Mesh read_values(std::string_view bytes, const PlyHeader& header, const std::string& file,
                 std::vector<std::string>& messages) {
  return PlyReader<Values>(Values(bytes, header, file), file).read(header, messages);
}

}  // namespace

Mesh read_ply(const std::filesystem::path& file, std::vector<std::string>& messages) {
  const std::string bytes = is_gzip_name(file) ? read_gzip_file(file) : read_whole_file(file);
  const std::string name = file.string();
  const PlyHeader header = read_ply_header(bytes, name);
  switch (header.format) {
    case PlyFormat::ascii:
      return read_values<PlyWords>(bytes, header, name, messages);
    case PlyFormat::binary_little_endian:
      return read_values<PlyBytes<std::endian::little>>(bytes, header, name, messages);
    case PlyFormat::binary_big_endian:
      return read_values<PlyBytes<std::endian::big>>(bytes, header, name, messages);
  }
  return {};
}

Imported import_ply(const std::filesystem::path& file) {
  Imported imported{{}, {file}};
  imported.scene.meshes.push_back(read_ply(file, imported.scene.notes.messages));
  imported.scene.instances.push_back({0, {}});
  return imported;
}

}  // namespace boxwood
