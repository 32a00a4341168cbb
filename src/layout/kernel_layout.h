#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>

#include "layout/layout.h"
#include "layout/leaves.h"
#include "layout/saved_level.h"

namespace boxwood {

/// Nodes of some layout over leaf content of some kind: all that a kernel reads.
template <class Nodes, class Leaves>
struct Level {
  Nodes nodes;
  Leaves leaves;
  Reach extent;
  bool cull = true;
};

/// The kernels of one level, compiled for one instruction set and one way of walking. A one-ray kernel improves `best`
/// and leaves it alone when nothing wins over it; the counted ones add to `counters`.
template <class Nodes, class Leaves>
struct Kernels {
  using LevelType = Level<Nodes, Leaves>;
  using Closest = void (*)(const LevelType&, const Ray&, Descent, Hit& best, RayCounters* counters);
  using Any = bool (*)(const LevelType&, const Ray&, std::uint32_t mask, RayCounters* counters);
  Closest closest = nullptr, closest_counted = nullptr;
  Any any = nullptr, any_counted = nullptr;
  void (*closest_batch)(const LevelType&, std::span<const Ray>, std::span<Hit>) = nullptr;
  void (*any_batch)(const LevelType&, std::span<const Ray>, std::span<std::uint8_t>) = nullptr;
  void (*offer)(const LevelType&, const Ray&, Descent, HitSink& sink) = nullptr;
  /// Where a batch does not cost what its rays alone do; null elsewhere.
  void (*closest_batch_counted)(const LevelType&, std::span<const Ray>, std::span<Hit>,
                                std::span<RayCounters>) = nullptr;
  void (*any_batch_counted)(const LevelType&, std::span<const Ray>, std::span<std::uint8_t>,
                            std::span<RayCounters>) = nullptr;
  /// Where batches of rays with masks are more than their rays one by one; null elsewhere.
  void (*closest_batch_masked)(const LevelType&, std::span<const Ray>, std::span<const std::uint32_t> masks,
                               std::span<Hit>) = nullptr;
  void (*any_batch_masked)(const LevelType&, std::span<const Ray>, std::span<const std::uint32_t> masks,
                           std::span<std::uint8_t>) = nullptr;
};

/// A layout that is nothing but a level and its kernels.
template <class Nodes, class Leaves>
class KernelLayout final : public Layout {
 public:
  KernelLayout(Level<Nodes, Leaves> level, const Kernels<Nodes, Leaves>& kernels)
      : level_(std::move(level)), kernels_(kernels) {}

  Hit closest_hit(const Ray& ray) const override {
    Hit best;
    kernels_.closest(level_, ray, {}, best, nullptr);
    return best;
  }
  bool any_hit(const Ray& ray) const override { return kernels_.any(level_, ray, every_bit, nullptr); }
  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const override {
    kernels_.closest_batch(level_, rays, hits);
  }
  void any_hits(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const override {
    kernels_.any_batch(level_, rays, blocked);
  }
  void closest_hits_counted(std::span<const Ray> rays, std::span<Hit> hits,
                            std::span<RayCounters> counters) const override {
    if (kernels_.closest_batch_counted) return kernels_.closest_batch_counted(level_, rays, hits, counters);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hits[i] = {};
      counters[i] = {};
      kernels_.closest_counted(level_, rays[i], {}, hits[i], &counters[i]);
    }
  }
  void any_hits_counted(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                        std::span<RayCounters> counters) const override {
    if (kernels_.any_batch_counted) return kernels_.any_batch_counted(level_, rays, blocked, counters);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      counters[i] = {};
      blocked[i] = kernels_.any_counted(level_, rays[i], every_bit, &counters[i]) ? 1 : 0;
    }
  }
  void closest_below(const Ray& ray, Descent descent, Hit& best, RayCounters* counters) const override {
    (counters ? kernels_.closest_counted : kernels_.closest)(level_, ray, descent, best, counters);
  }
  bool any_below(const Ray& ray, std::uint32_t mask, RayCounters* counters) const override {
    return (counters ? kernels_.any_counted : kernels_.any)(level_, ray, mask, counters);
  }
  void closest_hits_masked(std::span<const Ray> rays, std::span<const std::uint32_t> masks,
                           std::span<Hit> hits) const override {
    if constexpr (std::is_same_v<Leaves, TriangleLeaves>) return closest_hits(rays, hits);
    if (kernels_.closest_batch_masked) return kernels_.closest_batch_masked(level_, rays, masks, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hits[i] = {};
      kernels_.closest(level_, rays[i], {0, masks[i]}, hits[i], nullptr);
    }
  }
  void any_hits_masked(std::span<const Ray> rays, std::span<const std::uint32_t> masks,
                       std::span<std::uint8_t> blocked) const override {
    if constexpr (std::is_same_v<Leaves, TriangleLeaves>) return any_hits(rays, blocked);
    if (kernels_.any_batch_masked) return kernels_.any_batch_masked(level_, rays, masks, blocked);
    for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = kernels_.any(level_, rays[i], masks[i], nullptr) ? 1 : 0;
  }
  void offer_hits(const Ray& ray, Descent descent, HitSink& sink) const override {
    kernels_.offer(level_, ray, descent, sink);
  }
  Reach reach() const override {
    if constexpr (std::is_same_v<Leaves, TriangleLeaves>) return {};
    return level_.extent;
  }
  bool refit(const Tree& tree, const Mesh& mesh) override {
    if constexpr (std::is_same_v<Leaves, TriangleLeaves> && requires { level_.nodes.refit(tree); }) {
      level_.nodes.refit(tree);
      move_triangles(level_.leaves, mesh);
      level_.extent = extent_of(level_.leaves, {}, tree.empty() ? Box{} : tree.nodes[0].bounds, {});
      return true;
    }
    return false;
  }
  std::size_t bytes() const override { return level_.nodes.bytes() + level_.leaves.bytes(); }
  std::vector<LayoutFact> facts() const override {
    std::size_t topology = level_.nodes.bytes();
    if constexpr (requires { level_.nodes.topology_bytes(); }) topology = level_.nodes.topology_bytes();
    std::vector<LayoutFact> facts = {{"topology_bytes", static_cast<double>(topology)},
                                     {"leaf_bytes", static_cast<double>(bytes() - topology)}};
    if constexpr (requires { level_.nodes.facts(); }) {
      for (LayoutFact& fact : level_.nodes.facts()) facts.push_back(std::move(fact));
    }
    return facts;
  }
  std::optional<SavedLevel> saved() const override {
    if constexpr (requires(SavedLevel & out) { level_.nodes.save(out); }) {
      SavedLevel out;
      level_.nodes.save(out);
      save_leaves(level_.leaves, out);
      out.facts.reach = level_.extent.reach;
      out.facts.gain = level_.extent.gain;
      out.facts.cull = level_.cull ? 1 : 0;
      return out;
    }
    return {};
  }

 private:
  Level<Nodes, Leaves> level_;
  Kernels<Nodes, Leaves> kernels_;
};

}  // namespace boxwood
