#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "boxwood/box.h"
#include "boxwood/counters.h"
#include "boxwood/hit_filter.h"
#include "boxwood/hit_lists.h"
#include "boxwood/layout_fact.h"
#include "boxwood/ray.h"
#include "boxwood/recipe.h"
#include "boxwood/scene.h"

namespace boxwood {

class Layout;
struct ExpectedUse;

struct BuildOptions {
  unsigned threads = 0;  ///< 0: as many as the machine has. The tree is the same for any number.
  /// What will be traced, for recipes that want to know (boxwood/expected_use.h); must live until build() returns.
  const ExpectedUse* use = nullptr;
};

/// Whether building by `recipe` takes BuildOptions::use.
bool needs_use(const Recipe& recipe);

/// What a build cost and what it made.
struct BuildReport {
  double build_ms = 0;            ///< wall time from triangles to a structure that can be traced
  std::size_t bytes = 0;          ///< held by the structure, beyond the caller's mesh
  double sah_cost = 0;            ///< surface area cost, C_traversal = C_intersection = 1; summed over instanced meshes
  std::uint64_t nodes = 0;        ///< inner nodes and leaves before layout
  std::uint64_t primitives = 0;   ///< usable unique triangles
  std::uint64_t left_out = 0;     ///< triangles left out as degenerate or not finite
  std::vector<LayoutFact> facts;  ///< what the layout tells of itself, over all levels; see docs/octrees.md
  Box bounds;                     ///< of all that was built, in world space; empty when that is nothing
};

class InstancePaths;

/// An immutable acceleration structure. Copies share it. All queries are const and thread safe, run on the calling
/// thread, and allocate nothing but the lists that all_hits() returns. Rays outside the limits of Ray hit nothing.
///
/// Where queries take a mask, or one for each ray (an empty span: every bit), the ray passes through instances whose
/// masks have no bit in common with it; one without any bit hits nothing. Peers refuse masks by a UsageError.
class Structure {
 public:
  Structure(std::shared_ptr<const Layout> layout, BuildReport report, Recipe recipe,
            std::shared_ptr<const InstancePaths> paths = {});

  using Masks = std::span<const std::uint32_t>;

  /// The nearest hit with t in [ray.t_near, ray.t_far]; Hit::valid() is false on a miss.
  Hit closest_hit(const Ray& ray, std::uint32_t mask = every_bit) const;
  /// Whether anything is hit with t in [ray.t_near, ray.t_far].
  bool any_hit(const Ray& ray, std::uint32_t mask = every_bit) const;
  /// One hit per ray; the fast path. Throws UsageError when the spans differ in length.
  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits, Masks masks = {}) const;
  /// 1 where a ray is blocked, 0 where it is not. Throws UsageError when the spans differ in length.
  void any_hits(std::span<const Ray> rays, std::span<std::uint8_t> blocked, Masks masks = {}) const;
  /// As above, with what each ray cost. Slower; the answers are the same.
  void closest_hits_counted(std::span<const Ray> rays, std::span<Hit> hits, std::span<RayCounters> counters) const;
  void any_hits_counted(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                        std::span<RayCounters> counters) const;

  // More than the closest hit, on every layout but peers, which refuse by a UsageError. Hits are in order of (t,
  // instance, primitive); a triangle is hit once, also one in several leaves; a ray through an edge or a vertex hits
  // every triangle there. See docs/queries.md.

  /// Every hit with t in [ray.t_near, ray.t_far]. O(h log h) for h hits on top of one walk.
  std::vector<Hit> all_hits(const Ray& ray, std::uint32_t mask = every_bit) const;
  HitLists all_hits(std::span<const Ray> rays, Masks masks = {}) const;
  /// Fills `hits` with the first hits.size() hits and returns how many there were; the rest becomes misses.
  std::size_t first_hits(const Ray& ray, std::span<Hit> hits, std::uint32_t mask = every_bit) const;
  /// The first k hits of every ray: hits[i * k + n] is the n-th of ray i, a miss where there is none. Throws UsageError
  /// unless hits.size() == k * rays.size().
  void first_hits(std::span<const Ray> rays, std::size_t k, std::span<Hit> hits, Masks masks = {}) const;
  /// The first hit that `accept` takes. It is asked about hits in order, each once, until it takes one: the same calls
  /// on every layout.
  Hit closest_hit(const Ray& ray, HitFilter accept, std::uint32_t mask = every_bit) const;
  bool any_hit(const Ray& ray, HitFilter accept, std::uint32_t mask = every_bit) const;
  /// As above for every ray, one after the other; `accept` may ask for the ray's number, too.
  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits, HitFilter accept, Masks masks = {}) const;
  void any_hits(std::span<const Ray> rays, std::span<std::uint8_t> blocked, HitFilter accept, Masks masks = {}) const;

  /// Numbers that Hit::instance can have: 0 up to this. As many as the scene has instances, or as place() counts.
  std::uint32_t instance_numbers() const;
  /// What was placed in what, from the outermost down, of the instance that a hit names: indices into the scene's
  /// instances, or into those that each place() was given. O(levels * log instances). Throws UsageError on a number
  /// that no hit has.
  std::vector<std::uint32_t> instance_path(std::uint32_t instance) const;

  const BuildReport& report() const { return report_; }
  const Recipe& recipe() const { return recipe_; }
  /// What answers the queries; of use to the rooms of this project only.
  const std::shared_ptr<const Layout>& layout() const { return layout_; }
  const std::shared_ptr<const InstancePaths>& paths() const { return paths_; }

 private:
  const Layout& hit_layout() const;
  const Layout& layout_for(Masks masks, std::size_t rays) const;

  std::shared_ptr<const Layout> layout_;
  BuildReport report_;
  Recipe recipe_;
  std::shared_ptr<const InstancePaths> paths_;
};

/// Builds what `recipe` describes over `scene`. Deterministic: same input, same structure, for any number of threads.
/// Unusable triangles are left out and counted in report(). The scene may be freed afterwards; only the leaves of the
/// layout `compressed` read its meshes, which must outlive the structure. Throws UsageError when stages do not fit each
/// other or need a use that is not told, Error when the scene cannot be built.
Structure build(const Scene& scene, const Recipe& recipe, const BuildOptions& options = {});
Structure build(const Scene& scene, std::string_view recipe = "default", const BuildOptions& options = {});

/// Places structures in one above them: structures over meshes, over scenes, over custom primitives, or such as this
/// has made, up to 6 levels in all. `instances[i].mesh` is an index into `parts`. Hit::instance numbers the instances
/// that are at the bottom in the order in which they are placed: with n = parts[instances[i].mesh].instance_numbers(),
/// instance i has the n numbers after those of instance i - 1. Structure::instance_path() tells the way to one.
///
/// A ray is mapped into the space of every level in turn, and must have a bit in common with the mask of every instance
/// on its way. `recipe` is that of the level that is added; the parts keep theirs and are shared, not copied. O(n log
/// n) for n instances. Throws UsageError on a part that does not exist or is a peer, Error on a transform without
/// inverse or more than 2^32 - 2 numbers.
Structure place(std::span<const Structure> parts, std::span<const Instance> instances, const Recipe& recipe,
                const BuildOptions& options = {});
Structure place(std::span<const Structure> parts, std::span<const Instance> instances,
                std::string_view recipe = "default", const BuildOptions& options = {});

}  // namespace boxwood
