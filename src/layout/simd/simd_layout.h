#pragma once
#include <cstddef>
#include <span>
#include <utility>

#include "layout/layout.h"
#include "layout/saved_level.h"
#include "layout/simd/wide_kernels.h"

namespace boxwood {

/// `Memory` holds the encoded tree: a `view` of it, how many `bytes()` it has and `facts()` about them.
template <class Memory>
class SimdLayout final : public Layout {
 public:
  SimdLayout(Memory memory, const WideKernels& kernels) : memory_(std::move(memory)), kernels_(kernels) {}

  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const override {
    kernels_.closest_hits(memory_.view, rays, hits);
  }
  void any_hits(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const override {
    kernels_.any_hits(memory_.view, rays, blocked);
  }
  Hit closest_hit(const Ray& ray) const override { return kernels_.closest_hit(memory_.view, ray); }
  bool any_hit(const Ray& ray) const override { return kernels_.any_hit(memory_.view, ray); }
  void closest_hits_counted(std::span<const Ray> rays, std::span<Hit> hits,
                            std::span<RayCounters> counters) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      counters[i] = {};
      hits[i] = kernels_.closest_hit_counted(memory_.view, rays[i], counters[i]);
    }
  }
  void any_hits_counted(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                        std::span<RayCounters> counters) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      counters[i] = {};
      blocked[i] = kernels_.any_hit_counted(memory_.view, rays[i], counters[i]) ? 1 : 0;
    }
  }
  void offer_hits(const Ray& ray, Descent descent, HitSink& sink) const override {
    kernels_.offer_hits(memory_.view, ray, descent.first_instance, sink);
  }
  bool refit(const Tree& tree, const Mesh& mesh) override {
    if constexpr (requires { memory_.refit(tree, mesh); }) {
      memory_.refit(tree, mesh);
      return true;
    }
    return false;
  }
  std::size_t bytes() const override { return memory_.bytes(); }
  std::optional<SavedLevel> saved() const override {
    if constexpr (requires(SavedLevel & out) { memory_.save(out); }) {
      SavedLevel out;
      memory_.save(out);
      return out;
    }
    return {};
  }
  std::vector<LayoutFact> facts() const override { return memory_.facts(); }

 private:
  Memory memory_;
  WideKernels kernels_;
};

}  // namespace boxwood
