#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "boxwood/recipe.h"
#include "boxwood/scene.h"
#include "boxwood/structure.h"

namespace boxwood {

/// What is built anew when vertices have moved; boxes of all else are fitted to where it is now.
enum class Rebuild : std::uint8_t {
  when_it_pays,  ///< parts or all, once refitting them has cost as much as that; see MotionPolicy
  never,         ///< only refit, unless it is not valid
  worst_parts,   ///< each time an eighth of the triangles, where cost rose most, and the nodes above all parts
  all,           ///< each time everything
};

/// When a rebuild pays: refitted boxes make every ray a little dearer, a rebuild costs once. Both are counted in units
/// of the surface area cost, which are node visits and triangle tests, so that decisions do not depend on a clock.
struct MotionPolicy {
  Rebuild rebuild = Rebuild::when_it_pays;
  double rays_per_update = 1e6;  ///< that are traced between two updates; >= 0
  /// What building costs per triangle: as much as this many node visits and triangle tests; > 0. See docs/moving.md.
  double build_price = 50;
};

/// What an update did. Meshes that did not move are in none of the counts.
struct UpdateReport {
  double update_ms = 0;                                          ///< wall time
  std::uint32_t refitted = 0, rebuilt_in_part = 0, rebuilt = 0;  ///< meshes
  std::uint64_t rebuilt_triangles = 0;                           ///< of rebuilt meshes and parts
  bool placed_anew = false;                                      ///< the level of instances was built anew
  std::string reason;  ///< why a mesh was rebuilt that could not be refitted; else empty
};

/// How good a refitted mesh is. Costs as in BuildReport::sah_cost; overlap is the area that siblings share, over the
/// area of their parents.
struct MotionQuality {
  double sah_cost = 0, sah_cost_when_built = 0;
  double overlap = 0, overlap_when_built = 0;
};

/// A structure over a scene that moves. Holds the scene, and beside the structure the tree of every mesh (32 bytes per
/// node). Changes are told first and take effect together, by update(). Deterministic for any number of threads. Not
/// for several threads at once, but structures it has given out are immutable as any and may be traced while it works
/// (those over `compressed` leaves only until the next update, because they read the scene's vertices).
class MovingStructure {
 public:
  /// Builds. Throws as build() does, and UsageError on a policy out of range.
  MovingStructure(Scene scene, const Recipe& recipe, const MotionPolicy& policy = {}, const BuildOptions& options = {});
  MovingStructure(Scene scene, std::string_view recipe = "default", const MotionPolicy& policy = {},
                  const BuildOptions& options = {});
  MovingStructure(MovingStructure&&) noexcept;
  MovingStructure& operator=(MovingStructure&&) noexcept;
  ~MovingStructure();

  /// As of the last update; a copy keeps it. After an update that threw: Error until one succeeds.
  Structure structure() const;
  /// With all changes, those not yet in effect as well. Removed instances keep their numbers.
  const Scene& scene() const;

  /// Why this mesh cannot be refitted but is built anew each time it moves, as a sentence; empty when it can. Throws
  /// UsageError on a number out of range, as all that take one do.
  std::string why_no_refit(std::uint32_t mesh = 0) const;
  /// Of a mesh that can be refitted, as of the last update. O(nodes).
  MotionQuality quality(std::uint32_t mesh = 0) const;

  /// New places for all vertices of a mesh. Throws UsageError unless there are as many as before.
  void move_vertices(std::uint32_t mesh, std::span<const Vec3> positions);
  /// Adds a mesh, to be placed by add_instance(); returns its number. Throws Error on an index out of range.
  std::uint32_t add_mesh(Mesh mesh);
  void move_instance(std::uint32_t instance, const Transform& object_to_world);
  /// Returns its number.
  std::uint32_t add_instance(const Instance& instance);
  /// Nothing hits it any more. Numbers of others stay, and this one is not used again.
  void remove_instance(std::uint32_t instance);

  void set_policy(const MotionPolicy& policy);
  /// Brings the structure up to date: refits or rebuilds meshes that moved, and builds the level of instances anew when
  /// there is one and anything changed. Vertices are refitted in place by `wide(4)`, `wide(8)`, `wide(16)` and
  /// `binary`, unless the caller holds the last structure; other layouts are encoded anew from the refitted tree.
  UpdateReport update();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace boxwood
