#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "boxwood/scene.h"
#include "scene/importers/pbrt/notes.h"

namespace boxwood::pbrt {

/// Collects shapes into meshes: those of the world into one in world space, those of each object into one of its own,
/// which is placed as often as the file says. Objects may place objects defined before them; their placements are
/// multiplied out.
class Assembly {
 public:
  /// How a shape is placed and what it is made of.
  struct Placing {
    Transform to_world;
    bool reverse = false;  ///< the other side is the front
    std::uint16_t material = 0;
  };

  /// Appends to the object being defined, else to the world. Throws Error naming `place` when a mesh grows too large.
  void add(const Mesh& shape, const Placing& placing, const std::string& place);

  bool defining() const { return defining_; }
  void begin_object(std::string name);
  void end_object();
  /// Places an object; false when there is none of that name. Throws Error naming `place` beyond 2^24 placements or
  /// 64 levels.
  bool place_object(const std::string& name, const Transform& to_world, const std::string& place);

  /// The number of a material equal to this one but for its name. Throws Error naming `place` beyond 65,535.
  std::uint16_t material(const Material& material, const std::string& place);

  /// Everything that was collected; meshes of objects that are placed nowhere come without an instance.
  Scene finish();

 private:
  struct Part {
    std::uint32_t object;
    Transform to_parent;
  };
  struct Object {
    Mesh mesh;
    std::vector<Part> parts;
    std::uint64_t placements = 0;  ///< of objects, itself included, that one placement of this one makes
    std::uint32_t depth = 1;       ///< of objects in objects
  };
  using MaterialKey = std::vector<float>;

  void expand(std::uint32_t object, const Transform& to_world, Scene& scene) const;
  std::vector<Object> objects_ = std::vector<Object>(1);  // the first is the world
  std::map<std::string, std::uint32_t> names_;
  std::string defined_name_;
  bool defining_ = false;
  std::vector<Material> materials_;
  std::map<MaterialKey, std::uint16_t> material_numbers_;
};

}  // namespace boxwood::pbrt
