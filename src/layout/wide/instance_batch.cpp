#include "layout/wide/instance_batch.h"

#include "layout/simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/wide/instance_batch.cpp"
#include <hwy/foreach_target.h>
//
#include <algorithm>
#include <bit>
#include <cstring>

#include "layout/wide/leaf_walk-inl.h"
#include "trace/object_ray.h"
#include "trace/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// Rays on their way at once, and the open ends each may have; a ray that needs more goes alone.
inline constexpr std::uint32_t rays_under_way = 512, open_ends = 56;
/// Fewer rays than this in one structure go one by one.
inline constexpr std::uint32_t least_together = 8;

struct InstanceVisit {
  std::uint32_t ray, leaf;  ///< numbers under way, and among the leaves
};

/// One ray on its way through the level of instances, entry by entry.
template <int K>
class InstanceWalk {
  using LevelType = Level<WideNodes, InstanceLeaves>;

 public:
  /// False when it meets nothing.
  HWY_INLINE bool start(const LevelType& level, const Ray& ray) {
    left_.count = 0;
    NoCounting none(nullptr);
    return walk_.start(level.nodes, level.extent, ray, none);
  }

  /// Goes on to the next instance that the ray may hit at or before `limit`.
  HWY_INLINE LeafStep next(const LevelType& level, float limit, std::uint32_t& leaf) {
    NoCounting none(nullptr);
    while (left_.count == 0) {
      const LeafStep step = walk_.next(level.nodes, limit, left_, none);
      if (step != LeafStep::visit) return step;
    }
    leaf = left_.first++;
    --left_.count;
    return LeafStep::visit;
  }

 private:
  Link left_;
  LeafWalk<K, open_ends> walk_;
};

/// Sorts visits so that those of one structure lie together, and within it those of one instance, each in the order of
/// rays. Counts instances in a table, because there are few different ones and many rays, or the other way round.
class VisitOrder {
 public:
  /// Calls run(structure, visits) for each structure.
  template <class Run>
  void for_each_structure(const InstanceLeaves& leaves, const InstanceVisit* visits, std::uint32_t count, Run run) {
    find_instances(visits, count);
    std::uint32_t order[rays_under_way];
    for (std::uint32_t i = 0; i < instances_; ++i) order[i] = i;
    const auto bottom_of = [&](std::uint32_t i) { return leaves.instances[leaf_[i]].bottom; };
    std::sort(order, order + instances_, [&](std::uint32_t a, std::uint32_t b) {
      return bottom_of(a) != bottom_of(b) ? std::less<>()(bottom_of(a), bottom_of(b)) : a < b;
    });
    std::uint32_t place = 0;
    for (std::uint32_t i = 0; i < instances_; ++i) {
      begin_[order[i]] = place;
      place += size_[order[i]];
    }
    for (std::uint32_t v = 0; v < count; ++v) sorted_[begin_[instance_of_[v]]++] = visits[v];
    for (std::uint32_t i = 0, end = 0, from = 0; i < instances_; ++i) {
      end += size_[order[i]];
      if (i + 1 < instances_ && bottom_of(order[i + 1]) == bottom_of(order[i])) continue;
      run(*bottom_of(order[i]), std::span<const InstanceVisit>(sorted_ + from, end - from));
      from = end;
    }
  }

 private:
  static constexpr std::uint32_t table_size = 2 * rays_under_way;

  void find_instances(const InstanceVisit* visits, std::uint32_t count) {
    std::memset(table_, 0, sizeof table_);
    instances_ = 0;
    for (std::uint32_t v = 0; v < count; ++v) {
      const std::uint32_t leaf = visits[v].leaf;
      std::uint32_t slot = leaf * 0x9e3779b1u >> (32 - std::countr_zero(table_size));
      while (table_[slot] != 0 && leaf_[table_[slot] - 1] != leaf) slot = (slot + 1) % table_size;
      if (table_[slot] == 0) {
        leaf_[instances_] = leaf;
        size_[instances_] = 0;
        table_[slot] = static_cast<std::uint16_t>(++instances_);
      }
      instance_of_[v] = static_cast<std::uint16_t>(table_[slot] - 1);
      ++size_[instance_of_[v]];
    }
  }

  std::uint16_t table_[table_size];  ///< one more than the number of an instance; 0: free
  std::uint32_t instances_ = 0;
  std::uint32_t leaf_[rays_under_way], size_[rays_under_way], begin_[rays_under_way];
  std::uint16_t instance_of_[rays_under_way];
  InstanceVisit sorted_[rays_under_way];
};

/// `Query` keeps what has been found for the rays under way, and enters structures.
template <int K, class Query>
class BatchThroughInstances {
  using LevelType = Level<WideNodes, InstanceLeaves>;

 public:
  BatchThroughInstances(const LevelType& level, Query& query) : level_(level), query_(query) {}

  void run(std::span<const Ray> rays) {
    for (std::size_t begin = 0; begin < rays.size(); begin += rays_under_way) {
      const std::size_t count = std::min<std::size_t>(rays_under_way, rays.size() - begin);
      run_some(rays.subspan(begin, count), begin);
    }
  }

 private:
  void run_some(std::span<const Ray> rays, std::size_t begin) {
    query_.begin(rays, begin);
    active_count_ = 0;
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
      if (walks_[i].start(level_, rays[i])) active_[active_count_++] = i;
    }
    while (active_count_ != 0) {
      const std::uint32_t visits = advance();
      order_.for_each_structure(level_.leaves, visits_, visits,
                                [&](const Layout& bottom, std::span<const InstanceVisit> together) {
                                  query_.enter(level_.leaves, bottom, together);
                                });
    }
  }

  /// Every ray goes on to its next instance; those that have come to an end are no longer active.
  std::uint32_t advance() {
    std::uint32_t visits = 0;
    for (std::uint32_t a = 0; a < active_count_; ++a) {
      const std::uint32_t i = active_[a];
      std::uint32_t leaf = 0;
      if (query_.finished(i)) continue;
      LeafStep step;
      do {
        step = walks_[i].next(level_, query_.limit(i), leaf);
      } while (step == LeafStep::visit && (level_.leaves.instances[leaf].mask & query_.mask(i)) == 0);
      if (step == LeafStep::visit) {
        active_[visits] = i;
        visits_[visits++] = {i, leaf};
      } else if (step == LeafStep::overflow) {
        query_.alone(i);
      }
    }
    active_count_ = visits;
    return visits;
  }

  const LevelType& level_;
  Query& query_;
  std::uint32_t active_count_ = 0;
  std::uint32_t active_[rays_under_way];
  InstanceVisit visits_[rays_under_way];
  VisitOrder order_;
  InstanceWalk<K> walks_[rays_under_way];
};

/// What both queries keep of the rays under way.
class RaysUnderWay {
 public:
  RaysUnderWay(const Level<WideNodes, InstanceLeaves>& level, std::span<const std::uint32_t> masks)
      : single_(wide_instance_kernels({})), level_(level), all_masks_(masks) {}

  HWY_INLINE std::uint32_t mask(std::uint32_t i) const { return masks_ ? masks_[i] : every_bit; }

 protected:
  void begin_rays(std::span<const Ray> rays, std::size_t first) {
    rays_ = rays.data();
    masks_ = all_masks_.empty() ? nullptr : all_masks_.data() + first;
  }
  HWY_INLINE Ray object_ray_of(const InstanceLeaves& leaves, const InstanceVisit& visit) const {
    return object_ray(leaves.instances[visit.leaf].world_to_object, rays_[visit.ray]);
  }
  std::span<const std::uint32_t> object_masks(std::span<const InstanceVisit> together) {
    for (std::size_t v = 0; v < together.size(); ++v) object_masks_[v] = masks_[together[v].ray];
    return {object_masks_, together.size()};
  }

  const Kernels<WideNodes, InstanceLeaves> single_;
  const Level<WideNodes, InstanceLeaves>& level_;
  std::span<const std::uint32_t> all_masks_;
  const Ray* rays_ = nullptr;
  const std::uint32_t* masks_ = nullptr;  ///< null: every bit
  Ray object_rays_[rays_under_way];

 private:
  std::uint32_t object_masks_[rays_under_way];
};

class ClosestThroughInstances : public RaysUnderWay {
 public:
  ClosestThroughInstances(const Level<WideNodes, InstanceLeaves>& level, std::span<const std::uint32_t> masks,
                          std::span<Hit> hits)
      : RaysUnderWay(level, masks), all_hits_(hits) {}

  void begin(std::span<const Ray> rays, std::size_t first) {
    begin_rays(rays, first);
    hits_ = all_hits_.data() + first;
    std::fill_n(hits_, rays.size(), Hit{});
  }
  static bool finished(std::uint32_t) { return false; }
  HWY_INLINE float limit(std::uint32_t i) const { return hits_[i].t < rays_[i].t_far ? hits_[i].t : rays_[i].t_far; }
  void alone(std::uint32_t i) { single_.closest(level_, rays_[i], {0, mask(i)}, hits_[i], nullptr); }

  void enter(const InstanceLeaves& leaves, const Layout& bottom, std::span<const InstanceVisit> together) {
    if (together.size() < least_together) {
      for (const InstanceVisit& visit : together) {
        const Descent descent{leaves.instances[visit.leaf].instance, mask(visit.ray)};
        bottom.closest_below(object_ray_of(leaves, visit), descent, hits_[visit.ray], nullptr);
      }
      return;
    }
    for (std::size_t v = 0; v < together.size(); ++v) {
      object_rays_[v] = object_ray_of(leaves, together[v]);
      object_rays_[v].t_far = limit(together[v].ray);
    }
    const std::span<const Ray> rays{object_rays_, together.size()};
    if (masks_) {
      bottom.closest_hits_masked(rays, object_masks(together), {object_hits_, together.size()});
    } else {
      bottom.closest_hits(rays, {object_hits_, together.size()});
    }
    for (std::size_t v = 0; v < together.size(); ++v) {
      Hit hit = object_hits_[v];
      if (!hit.valid()) continue;
      hit.instance += leaves.instances[together[v].leaf].instance;
      Hit& best = hits_[together[v].ray];
      if (wins(hit.t, hit.instance, hit.primitive, best)) best = hit;
    }
  }

 private:
  std::span<Hit> all_hits_;
  Hit* hits_ = nullptr;
  Hit object_hits_[rays_under_way];
};

class AnyThroughInstances : public RaysUnderWay {
 public:
  AnyThroughInstances(const Level<WideNodes, InstanceLeaves>& level, std::span<const std::uint32_t> masks,
                      std::span<std::uint8_t> blocked)
      : RaysUnderWay(level, masks), all_blocked_(blocked) {}

  void begin(std::span<const Ray> rays, std::size_t first) {
    begin_rays(rays, first);
    blocked_ = all_blocked_.data() + first;
    std::fill_n(blocked_, rays.size(), std::uint8_t{0});
  }
  HWY_INLINE bool finished(std::uint32_t i) const { return blocked_[i] != 0; }
  HWY_INLINE float limit(std::uint32_t i) const { return rays_[i].t_far; }
  void alone(std::uint32_t i) { blocked_[i] = single_.any(level_, rays_[i], mask(i), nullptr) ? 1 : 0; }

  void enter(const InstanceLeaves& leaves, const Layout& bottom, std::span<const InstanceVisit> together) {
    for (std::size_t v = 0; v < together.size(); ++v) object_rays_[v] = object_ray_of(leaves, together[v]);
    if (together.size() < least_together) {
      for (std::size_t v = 0; v < together.size(); ++v) {
        const std::uint32_t ray = together[v].ray;
        blocked_[ray] = bottom.any_below(object_rays_[v], mask(ray), nullptr) ? 1 : 0;
      }
      return;
    }
    const std::span<const Ray> rays{object_rays_, together.size()};
    if (masks_) {
      bottom.any_hits_masked(rays, object_masks(together), {object_blocked_, together.size()});
    } else {
      bottom.any_hits(rays, {object_blocked_, together.size()});
    }
    for (std::size_t v = 0; v < together.size(); ++v) blocked_[together[v].ray] = object_blocked_[v];
  }

 private:
  std::span<std::uint8_t> all_blocked_;
  std::uint8_t* blocked_ = nullptr;
  std::uint8_t object_blocked_[rays_under_way];
};

template <int K>
struct BatchOf {
  using LevelType = Level<WideNodes, InstanceLeaves>;

  static void closest_masked(const LevelType& level, std::span<const Ray> rays, std::span<const std::uint32_t> masks,
                             std::span<Hit> hits) {
    if (rays.size() < least_together || level.nodes.empty()) {
      const Kernels<WideNodes, InstanceLeaves> single = wide_instance_kernels({});
      for (std::size_t i = 0; i < rays.size(); ++i) {
        hits[i] = {};
        single.closest(level, rays[i], {0, masks.empty() ? every_bit : masks[i]}, hits[i], nullptr);
      }
      return;
    }
    ClosestThroughInstances query(level, masks, hits);
    BatchThroughInstances<K, ClosestThroughInstances>(level, query).run(rays);
  }
  static void any_masked(const LevelType& level, std::span<const Ray> rays, std::span<const std::uint32_t> masks,
                         std::span<std::uint8_t> blocked) {
    if (rays.size() < least_together || level.nodes.empty()) {
      const Kernels<WideNodes, InstanceLeaves> single = wide_instance_kernels({});
      for (std::size_t i = 0; i < rays.size(); ++i) {
        blocked[i] = single.any(level, rays[i], masks.empty() ? every_bit : masks[i], nullptr) ? 1 : 0;
      }
      return;
    }
    AnyThroughInstances query(level, masks, blocked);
    BatchThroughInstances<K, AnyThroughInstances>(level, query).run(rays);
  }
  static void closest(const LevelType& level, std::span<const Ray> rays, std::span<Hit> hits) {
    closest_masked(level, rays, {}, hits);
  }
  static void any(const LevelType& level, std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
    any_masked(level, rays, {}, blocked);
  }
  static InstanceBatch table() { return {closest, any, closest_masked, any_masked}; }
};

InstanceBatch instance_batch_of(std::uint32_t k) {
  switch (k) {
    case 4:
      return BatchOf<4>::table();
    case 8:
      return BatchOf<8>::table();
    case 16:
      return BatchOf<16>::table();
    default:
      return {};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(instance_batch_of);

InstanceBatch instance_batch(std::uint32_t k) { return HWY_DYNAMIC_DISPATCH(instance_batch_of)(k); }

Kernels<WideNodes, InstanceLeaves> wide_instance_kernels_of(std::uint32_t k, const TraceOptions& options) {
  Kernels<WideNodes, InstanceLeaves> kernels = wide_instance_kernels(options);
  if (options != TraceOptions{}) return kernels;
  const InstanceBatch batch = instance_batch(k);
  if (batch.closest) kernels.closest_batch = batch.closest;
  if (batch.any) kernels.any_batch = batch.any;
  kernels.closest_batch_masked = batch.closest_masked;
  kernels.any_batch_masked = batch.any_masked;
  return kernels;
}

}  // namespace boxwood
#endif
