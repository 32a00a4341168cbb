// Wavefront OBJ: vertices, faces and materials, in one mesh. Groups, smoothing and free-form surfaces are passed over.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <unordered_map>

#include "scene/importers/importer.h"
#include "scene/importers/obj_vertices.h"
#include "scene/importers/polygon.h"
#include "scene/importers/repeated_note.h"
#include "scene/importers/text_file.h"

namespace boxwood {
namespace {

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::filesystem::path& file) : cursor_(text, file.string()), file_(file) {
    imported_.files.push_back(file);
  }

  Imported read() {
    for (; !cursor_.at_end(); cursor_.next_line()) read_statement(cursor_.word());
    if (vertices_.positions.empty()) {
      throw Error(fmt::format("{}: has no vertices, so it is no Wavefront OBJ text; check what it is", file_.string()));
    }
    vertices_.move_into(mesh_);
    Scene& scene = imported_.scene;
    for (const RepeatedNote* note : {&out_of_range_, &too_short_, &not_faces_, &unknown_material_}) {
      note->report(scene.notes.messages);
    }
    scene.meshes.push_back(std::move(mesh_));
    scene.instances.push_back({0, {}});
    return std::move(imported_);
  }

 private:
  void read_statement(std::string_view keyword) {
    if (keyword == "v") {
      vertices_.positions.push_back(read_vector("a coordinate"));
    } else if (keyword == "vn") {
      vertices_.normals.push_back(read_vector("a component of a normal"));
    } else if (keyword == "vt") {
      read_texture_coordinate();
    } else if (keyword == "f" || keyword == "fo") {
      read_face();
    } else if (keyword == "usemtl") {
      use_material(std::string(cursor_.rest_of_line()));
    } else if (keyword == "mtllib") {
      read_materials(std::string(cursor_.rest_of_line()));
    } else if (keyword == "l" || keyword == "p" || keyword == "surf" || keyword == "curv" || keyword == "curv2") {
      not_faces_.add([&] {
        return fmt::format("{}: points, lines and free-form surfaces ('{}') are not faces; they were skipped",
                           cursor_.place(), keyword);
      });
    }
  }

  Vec3 read_vector(std::string_view what) {
    const float x = cursor_.number(what), y = cursor_.number(what);
    return {x, y, cursor_.number(what)};
  }

  void read_texture_coordinate() {
    const float u = cursor_.number("a texture coordinate");
    TextCursor ahead = cursor_;
    const float v = ahead.word().empty() ? 0 : cursor_.number("a texture coordinate");
    vertices_.texture_coordinates.push_back({u, v});
  }

  /// Reads one index, 1 for the first or -1 for the last of `count`; an empty field stays `none`.
  const char* read_index(const char* at, const char* end, std::size_t count, std::string_view what,
                         std::uint32_t& index) {
    if (at == end || *at == '/') return at;
    std::int64_t number = 0;
    const auto [next, error] = std::from_chars(at, end, number);
    if (error == std::errc::invalid_argument || (next != end && *next != '/')) {
      cursor_.fail(fmt::format("'{}' is no corner of a face; write vertex, vertex/texture or vertex/texture/normal",
                               std::string_view(at, static_cast<std::size_t>(std::min<std::ptrdiff_t>(end - at, 40)))));
    }
    const auto size = static_cast<std::int64_t>(count);
    const std::int64_t from_zero = number < 0 ? size + number : number - 1;
    if (error == std::errc{} && number != 0 && from_zero >= 0 && from_zero < size) {
      index = static_cast<std::uint32_t>(from_zero);
      return next;
    }
    face_is_good_ = false;
    out_of_range_.add([&] {
      return fmt::format("{}: face refers to {} {} of {}; the face was skipped", cursor_.place(), what, number, count);
    });
    return next;
  }

  ObjCorner read_corner(std::string_view word) {
    const char* at = word.data();
    const char* const end = at + word.size();
    ObjCorner corner;
    at = read_index(at, end, vertices_.positions.size(), "vertex", corner.position);
    if (at != end)
      at = read_index(at + 1, end, vertices_.texture_coordinates.size(), "texture coordinate", corner.texture);
    if (at != end) read_index(at + 1, end, vertices_.normals.size(), "normal", corner.normal);
    if (face_is_good_ && corner.position == ObjCorner::none) {
      cursor_.fail(fmt::format("the corner '{}' of a face names no vertex", word.substr(0, 40)));
    }
    return corner;
  }

  void read_face() {
    corners_.clear();
    face_is_good_ = true;
    for (std::string_view word = cursor_.word(); !word.empty() && face_is_good_; word = cursor_.word()) {
      if (word.front() == '#') break;
      corners_.push_back(read_corner(word));
    }
    if (!face_is_good_) return;
    if (corners_.size() < 3) {
      return too_short_.add(
          [&] { return fmt::format("{}: face has {} corners; it was skipped", cursor_.place(), corners_.size()); });
    }
    polygon_.clear();
    cut_.clear();
    for (const ObjCorner& corner : corners_) polygon_.push_back(vertices_.positions[corner.position]);
    triangulate_polygon(polygon_, cut_);
    for (const Triangle& t : cut_) {
      const std::uint32_t a = vertices_.vertex(corners_[t[0]]), b = vertices_.vertex(corners_[t[1]]);
      mesh_.triangles.push_back({a, b, vertices_.vertex(corners_[t[2]])});
      if (material_ != no_material) mesh_.materials.push_back(material_);
    }
  }

  std::uint16_t add_material(Material material) {
    std::vector<Material>& all = imported_.scene.materials;
    if (all.size() >= no_material) cursor_.fail("has more than 65,535 materials; merge some");
    all.push_back(std::move(material));
    return static_cast<std::uint16_t>(all.size() - 1);
  }

  void use_material(std::string name) {
    if (material_ == no_material && !mesh_.triangles.empty()) {  // the faces so far have none
      mesh_.materials.assign(mesh_.triangles.size(), add_material({.name = "default"}));
    }
    const auto found = materials_.find(name);
    if (found != materials_.end()) {
      material_ = found->second;
      return;
    }
    unknown_material_.add([&] {
      return fmt::format("{}: the material '{}' is not defined; a default one is used", cursor_.place(), name);
    });
    material_ = materials_[name] = add_material({.name = name});
  }

  void read_materials(const std::string& name) {
    std::string portable = name;
    for (char& c : portable) c = c == '\\' ? '/' : c;
    const std::filesystem::path file = file_.parent_path() / portable;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) {
      imported_.scene.notes.messages.push_back(
          fmt::format("{}: the material file '{}' is missing; default materials are used", cursor_.place(), name));
      return;
    }
    imported_.files.push_back(file);
    for (Material& material : read_mtl(file, imported_.scene)) {
      std::string key = material.name;
      materials_.try_emplace(std::move(key), add_material(std::move(material)));
    }
  }

  static constexpr std::uint16_t no_material = 0xffff;
  TextCursor cursor_;
  std::filesystem::path file_;
  Imported imported_;
  Mesh mesh_;
  ObjVertices vertices_;
  std::unordered_map<std::string, std::uint16_t> materials_;
  std::uint16_t material_ = no_material;
  std::vector<ObjCorner> corners_;
  std::vector<Vec3> polygon_;
  std::vector<Triangle> cut_;
  bool face_is_good_ = true;
  RepeatedNote out_of_range_, too_short_, not_faces_, unknown_material_;
};

}  // namespace

Imported import_obj(const std::filesystem::path& file) {
  const std::string text = read_whole_file(file);
  return ObjReader(text, file).read();
}

}  // namespace boxwood
