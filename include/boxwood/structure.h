#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "boxwood/counters.h"
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
};

/// An immutable acceleration structure. Copies share it. All queries are const, thread safe and allocation free.
class Structure {
 public:
  Structure(std::shared_ptr<const Layout> layout, BuildReport report, Recipe recipe);

  /// The nearest hit with t in [ray.t_near, ray.t_far]; Hit::valid() is false on a miss.
  Hit closest_hit(const Ray& ray) const;
  /// Whether anything is hit with t in [ray.t_near, ray.t_far].
  bool any_hit(const Ray& ray) const;
  /// One hit per ray; the fast path. Throws UsageError when the spans differ in length.
  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const;
  /// 1 where a ray is blocked, 0 where it is not. Throws UsageError when the spans differ in length.
  void any_hits(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;
  /// As above, with what each ray cost. Slower; the answers are the same.
  void closest_hits_counted(std::span<const Ray> rays, std::span<Hit> hits, std::span<RayCounters> counters) const;
  void any_hits_counted(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                        std::span<RayCounters> counters) const;

  const BuildReport& report() const { return report_; }
  const Recipe& recipe() const { return recipe_; }
  /// What answers the queries; of use to the rooms of this project only.
  const std::shared_ptr<const Layout>& layout() const { return layout_; }

 private:
  std::shared_ptr<const Layout> layout_;
  BuildReport report_;
  Recipe recipe_;
};

/// Builds what `recipe` describes over `scene`. Deterministic: same input, same structure, for any number of threads.
/// Unusable triangles are left out and counted in report(). The scene may be freed afterwards; only the leaves of the
/// layout `compressed` read its meshes, which must outlive the structure. Throws UsageError when stages do not fit each
/// other or need a use that is not told, Error when the scene cannot be built.
Structure build(const Scene& scene, const Recipe& recipe, const BuildOptions& options = {});
Structure build(const Scene& scene, std::string_view recipe = "default", const BuildOptions& options = {});

}  // namespace boxwood
