#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "boxwood/scene.h"
#include "scene/importers/importer.h"
#include "scene/importers/pbrt/assembly.h"
#include "scene/importers/pbrt/colors.h"
#include "scene/importers/pbrt/materials.h"
#include "scene/importers/pbrt/notes.h"
#include "scene/importers/pbrt/parameters.h"
#include "scene/importers/pbrt/tokens.h"

namespace boxwood::pbrt {

/// What AttributeBegin keeps and AttributeEnd brings back.
struct Attributes {
  Transform to_world;
  bool reverse = false;
  Material material;
  Vec3 emission;
  bool emits_behind = false;
};

/// Executes the directives of a scene file and of those that it includes.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& file);
  Imported read();

 private:
  using Directive = void (Reader::*)();
  static const std::map<std::string_view, Directive>& directives();
  void execute(const std::string& word);
  void read_file(const std::filesystem::path& file);

  // transforms.cpp
  void identity();
  void translate();
  void scale();
  void rotate();
  void look_at();
  void transform();
  void concat_transform();
  void coordinate_system();
  void coord_sys_transform();
  void active_transform();
  void transform_times();
  void apply(const Transform& by);

  // reader.cpp
  void attribute_begin();
  void attribute_end();
  void transform_begin();
  void transform_end();
  void reverse_orientation();
  void world_begin();
  void nothing();
  void pass_over();  ///< up to the next directive
  void media();
  void include();
  void import();
  void object_begin();
  void object_end();
  void object_instance();

  // contents.cpp
  void camera();
  void film();
  void light_source();
  void area_light_source();
  void material();
  void make_named_material();
  void named_material();
  void texture();
  void shape();
  Imported finish();

  void open_scope(bool transform_only);
  void close_scope(bool transform_only);
  Tokens& tokens() { return *tokens_; }
  std::optional<std::filesystem::path> find_file(const std::string& name, const std::string& place);

  struct Scope {
    Attributes attributes;
    bool transform_only;
    std::string place;
  };

  std::filesystem::path folder_;
  Imported imported_;
  Tokens* tokens_ = nullptr;
  std::size_t includes_ = 0, include_depth_ = 0;
  Attributes now_;
  std::vector<Scope> scopes_;
  bool moves_start_ = true;  // ActiveTransform: transforms count for the start of motion
  std::map<std::string, Transform> coordinate_systems_;
  Notes notes_;
  std::set<std::filesystem::path> missing_;
  Colors colors_{notes_};
  Materials materials_{colors_, notes_};
  Assembly assembly_;
  std::vector<Light> lights_;
  std::optional<Camera> camera_;
  std::uint32_t width_ = 0, height_ = 0;
};

}  // namespace boxwood::pbrt
