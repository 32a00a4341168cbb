#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "boxwood/counters.h"
#include "boxwood/layout_fact.h"
#include "boxwood/ray.h"
#include "layout/descent.h"
#include "trace/hit_sink.h"
#include "trace/reach.h"

namespace boxwood {

struct Mesh;
struct SavedLevel;
struct Tree;

/// An immutable memory layout with its traversal kernels: the only thing a Structure holds. One virtual call per query,
/// and one per visit of an instance, never per node. Every layout gives the same answers, to the bit; only a peer,
/// whose triangle test is its own, does not.
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

  /// As a level below others, or of a ray with a mask: replaces `best` when this level has a hit that wins over it.
  /// `ray` is in this level's space. Adds to `counters` unless null. These defaults work through the queries above;
  /// kernels of our own override them, to start from the cut-off that `best` is.
  virtual void closest_below(const Ray& ray, Descent descent, Hit& best, RayCounters* counters) const;
  virtual bool any_below(const Ray& ray, std::uint32_t mask, RayCounters* counters) const;
  /// Batches of rays with masks, one for each. These defaults are for levels without instances.
  virtual void closest_hits_masked(std::span<const Ray> rays, std::span<const std::uint32_t> masks,
                                   std::span<Hit> hits) const;
  virtual void any_hits_masked(std::span<const Ray> rays, std::span<const std::uint32_t> masks,
                               std::span<std::uint8_t> blocked) const;

  /// Brings every hit of the ray to `sink`. The default is a peer's, which cannot.
  virtual void offer_hits(const Ray& ray, Descent descent, HitSink& sink) const;
  /// What a level above must add to its own error bound; see instance_error(). The default: triangles and no more.
  virtual Reach reach() const { return {}; }
  /// Throws the UsageError that says so.
  [[noreturn]] static void refuse_to_offer();

  /// Takes over the boxes of `tree`, which is the tree it was made from but for them, and the positions of `mesh`, in
  /// place. False, and nothing happens, where a layout cannot; it is then encoded anew. For the owner of the only
  /// reference, while nobody traces. Parallel; O(n).
  virtual bool refit(const Tree& tree, const Mesh& mesh);

  /// Bytes held, beyond the caller's mesh and the bottom levels.
  virtual std::size_t bytes() const = 0;
  /// What else it tells of itself: at least `topology_bytes`, what a walk reads at every step, inner nodes and leaves
  /// alike, and `leaf_bytes`, all other. Empty where these are not kept apart.
  virtual std::vector<LayoutFact> facts() const { return {}; }
  /// What files hold of it, referring to its memory; nothing when they cannot hold it.
  virtual std::optional<SavedLevel> saved() const;
};

/// Adds up the facts of several levels, name by name.
void add_facts(std::vector<LayoutFact>& sums, const std::vector<LayoutFact>& facts);

RayCounters& operator+=(RayCounters& sum, const RayCounters& more);

}  // namespace boxwood
