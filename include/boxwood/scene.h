#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "boxwood/box.h"
#include "boxwood/error.h"
#include "boxwood/ray.h"
#include "boxwood/transform.h"
#include "boxwood/vec3.h"

namespace boxwood {

using Triangle = std::array<std::uint32_t, 3>;  ///< three indices into Mesh::positions

/// Coordinates beyond this magnitude are treated like non-finite ones: products of three of them must stay finite.
inline constexpr float largest_coordinate = 1e12f;

/// Indexed triangles in object space. `materials` is empty or has one entry (an index into Scene::materials) per
/// triangle; `normals` and `texture_coordinates` are empty or have one entry per position.
struct Mesh {
  std::string name;
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  std::vector<std::uint16_t> materials;
  std::vector<Vec3> normals;
  std::vector<std::array<float, 2>> texture_coordinates;
};

/// One placement of a mesh in the world.
struct Instance {
  std::uint32_t mesh = 0;  ///< index into Scene::meshes
  Transform object_to_world;
  std::uint32_t mask = every_bit;  ///< rays without any of these bits in theirs pass through it
};

/// How a surface sends out and scatters light. Diffuse, specular, reflection and transmission are shares of the light
/// that arrives, per colour; where they exceed 1 together, renderers scale them down.
struct Material {
  static constexpr std::uint32_t no_texture = 0xffffffff;

  std::string name;
  Vec3 diffuse{0.7f, 0.7f, 0.7f};      ///< scattered evenly (Lambert)
  std::uint32_t texture = no_texture;  ///< index into Scene::textures: an image that `diffuse` is multiplied by
  Vec3 emission{0, 0, 0};              ///< radiance sent out
  Vec3 specular{0, 0, 0};              ///< scattered around the mirror direction (Phong)
  float shininess = 0;                 ///< exponent of that lobe
  Vec3 reflection{0, 0, 0};            ///< reflected as by a mirror
  Vec3 transmission{0, 0, 0};          ///< let through, bent by refraction_index; the sides are the triangles' own
  /// Of the inside, the back of the triangles, relative to the outside. Unless it is 1, Fresnel's equations divide what
  /// a transmitting surface lets through and mirrors.
  float refraction_index = 1;
  bool emits_behind = true;  ///< whether the back of the triangles sends out light as well
};

/// A picture that is repeated over surfaces. Texture coordinate (0, 0) is the lower left corner of the lower left
/// pixel.
struct Texture {
  std::string file;                     ///< that it is read from; empty: it was in the scene's own file
  std::uint32_t width = 0, height = 0;  ///< pixels; 0: not read, because the file is missing or no image
  std::vector<std::uint8_t> pixels;     ///< red, green, blue in sRGB, rows from the top; 3 width height bytes
};

/// Pinhole camera. `direction` need not be of unit length; `fov` is the angle in degrees across the shorter image side.
struct Camera {
  std::string name;
  Vec3 eye;
  Vec3 direction{0, 0, -1};
  Vec3 up{0, 1, 0};
  float fov = 60;
  bool mirrored = false;  ///< pictures are flipped left to right, as worlds with a left-handed frame need it
  std::uint32_t width = 0, height = 0;  ///< pixels that its file asks for; 0: it does not say
};

enum class LightKind : std::uint32_t {
  point,    ///< from `position` in all directions
  spot,     ///< from `position`, within a cone around `direction`
  distant,  ///< parallel, along `direction`
  sky,      ///< from everywhere, evenly
};

/// A light without a surface; surfaces give light by their material's emission.
struct Light {
  Vec3 position;
  /// Power per solid angle (point, spot), power per area that faces the light (distant), radiance (sky).
  Vec3 intensity{1, 1, 1};
  LightKind kind = LightKind::point;
  Vec3 direction{0, 0, -1};  ///< in which the light travels; unit length
  /// Cosines of the angles around `direction` up to which a spot shines fully, and from which on it does not at all.
  float full_cosine = 1, dark_cosine = 0;
};

/// What was found wrong with the input and left out or changed, one sentence each.
struct ImportNotes {
  std::uint64_t degenerate_triangles = 0;  ///< zero area; kept in the mesh, left out of every build
  std::uint64_t non_finite_triangles = 0;  ///< NaN, infinite or beyond largest_coordinate; likewise
  std::vector<std::string> messages;
};

/// Meshes, where they are placed, and what is needed to look at them. Triangles keep the number they have in their
/// mesh.
struct Scene {
  std::string name;
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<Camera> cameras;  ///< the first is the default
  std::vector<Light> lights;    ///< with the emissive materials, all that gives light
  ImportNotes notes;

  /// Adds one mesh, placed once as it stands. Throws Error on an index out of range. O(n).
  void add_mesh(std::vector<Vec3> positions, std::vector<Triangle> triangles);
  /// Triangles stored, each mesh once.
  std::uint64_t unique_triangles() const;
  /// Triangles placed, each mesh as often as it has instances.
  std::uint64_t placed_triangles() const;
  /// World bounds of every usable triangle; empty for an empty scene. O(n).
  Box bounds() const;
  /// True when one mesh is placed once by the identity, for all rays, so that one structure over its triangles is the
  /// whole scene.
  bool single_level() const;
  /// True when no triangle is placed.
  bool empty() const { return placed_triangles() == 0; }
};

/// A triangle that a build can use: finite, within largest_coordinate, and of non-zero area.
bool is_usable(const Mesh& mesh, std::uint32_t triangle);

/// Reads a scene from a file (OBJ, PLY, pbrt, glTF, GLB, STL, …) or makes one from "generate:NAME(option=value, …)".
/// Cameras are taken from the sidecar FILE-without-extension.cameras.json (or FOLDER.cameras.json beside the file's
/// folder) when it exists, then from the file, and one that frames the scene is always appended. Meshes placed once are
/// merged into one mesh in world space; meshes placed several times stay instances. Throws Error naming the file, the
/// place and the cure; UsageError for a bad generator.
Scene load(std::string_view path_or_generator);

/// The same scene with every instance written out as world-space triangles of one mesh. Masks are lost. O(placed
/// triangles).
Scene flatten(const Scene& scene);

}  // namespace boxwood
