#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "boxwood/counters.h"
#include "boxwood/ray.h"

namespace boxwood {

/// An immutable memory layout with its traversal kernels: the only thing a Structure holds. One virtual call per query,
/// never per node. Every layout gives the same answers, to the bit.
class Layout {
 public:
  virtual ~Layout() = default;

  virtual void closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const = 0;
  virtual void any_hits(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const = 0;
  virtual Hit closest_hit(const Ray& ray) const = 0;
  virtual bool any_hit(const Ray& ray) const = 0;
  virtual void closest_hits_counted(std::span<const Ray> rays, std::span<Hit> hits,
                                    std::span<RayCounters> counters) const = 0;
  virtual void any_hits_counted(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                                std::span<RayCounters> counters) const = 0;

  /// Bytes held, beyond the caller's mesh.
  virtual std::size_t bytes() const = 0;
};

}  // namespace boxwood
