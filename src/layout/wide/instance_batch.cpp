#include "layout/wide/instance_batch.h"

#include "layout/simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/wide/instance_batch.cpp"
#include <hwy/foreach_target.h>
//
#include <algorithm>
#include <bit>
#include <cstring>

#include "layout/simd/lanes-inl.h"
#include "trace/object_ray.h"
#include "trace/prepared_ray-inl.h"
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

/// One ray on its way through the level of instances.
template <int K>
class InstanceWalk {
  using D = Floats<K>;
  using LevelType = Level<WideNodes, InstanceLeaves>;

 public:
  /// False when it meets nothing.
  HWY_INLINE bool start(const LevelType& level, const Ray& ray) {
    top_ = 0;
    leaf_count_ = 0;
    prepared_ = prepare(ray, level.extent.reach, level.extent.gain);
    float entry;
    if (!prepared_.valid || !hit_box(level.nodes.root_box, prepared_, ray.t_far, entry)) return false;
    push_link(level.nodes.root, entry, 0);
    return true;
  }

  enum class Step : std::uint8_t { visit, done, overflow };

  /// Goes on to the next instance that the ray may hit at or before `limit`.
  HWY_INLINE Step next(const LevelType& level, float limit, std::uint32_t& leaf) {
    while (leaf_count_ == 0) {
      do {
        if (top_ == 0) return Step::done;
        --top_;
      } while (!(open_[top_].entry <= limit));
      const Link link = open_[top_].link;
      if (link.leaf) {
        leaf_first_ = link.first;
        leaf_count_ = link.count;
      } else if (!open_node(level, link, limit)) {
        return Step::overflow;
      }
    }
    leaf = leaf_first_++;
    --leaf_count_;
    return Step::visit;
  }

 private:
  struct Open {
    Link link;
    float entry;
  };

  HWY_INLINE void push_link(const Link& link, float entry, std::uint32_t bottom) {
    std::uint32_t place = top_++;
    for (; place != bottom && open_[place - 1].entry < entry; --place) open_[place] = open_[place - 1];
    open_[place] = {link, entry};
  }

  /// Puts the children that are met on the stack, the nearest on top.
  HWY_INLINE bool open_node(const LevelType& level, const Link& link, float limit) {
    if (HWY_UNLIKELY(top_ + link.count > open_ends)) return false;
    const D d;
    const float* node = level.nodes.memory.data() + std::size_t{link.first} * (8 * K);
    const std::uint32_t bottom = top_;
    alignas(64) float entries[K];
    for (int begin = 0; begin < K; begin += lanes_of<D>) {
      auto entry = hn::Set(d, prepared_.t_near), exit = hn::Set(d, limit);
      for (int axis = 0; axis < 3; ++axis) {
        const auto inverse = hn::Set(d, prepared_.inverse[axis]);
        const int near = axis + 3 * prepared_.negative[axis], far = axis + 3 * (1 - prepared_.negative[axis]);
        const auto near_plane = hn::LoadU(d, node + near * K + begin), far_plane = hn::LoadU(d, node + far * K + begin);
        entry = hn::Max(hn::MulSub(near_plane, inverse, hn::Set(d, prepared_.near_offset[axis])), entry);
        exit = hn::Min(hn::MulSub(far_plane, inverse, hn::Set(d, prepared_.far_offset[axis])), exit);
      }
      hn::Store(entry, d, entries + begin);
      std::uint32_t bits = bits_of(d, hn::Le(entry, exit)) << begin;
      for (bits &= (1u << link.count) - 1; bits != 0; bits &= bits - 1) {
        const int child = std::countr_zero(bits);
        Link to;
        std::memcpy(static_cast<void*>(&to), node + 6 * K + 2 * child, sizeof to);
        push_link(to, entries[child], bottom);
      }
    }
    return true;
  }

  PreparedRay prepared_;
  std::uint32_t top_, leaf_first_, leaf_count_;
  Open open_[open_ends];
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
  using Step = typename InstanceWalk<K>::Step;

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
      std::uint32_t leaf;
      if (query_.finished(i)) continue;
      const Step step = walks_[i].next(level_, query_.limit(i), leaf);
      if (step == Step::visit) {
        active_[visits] = i;
        visits_[visits++] = {i, leaf};
      } else if (step == Step::overflow) {
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

class ClosestThroughInstances {
 public:
  ClosestThroughInstances(const Kernels<WideNodes, InstanceLeaves>& single,
                          const Level<WideNodes, InstanceLeaves>& level, std::span<Hit> hits)
      : single_(single), level_(level), all_hits_(hits) {}

  void begin(std::span<const Ray> rays, std::size_t first) {
    rays_ = rays.data();
    hits_ = all_hits_.data() + first;
    std::fill_n(hits_, rays.size(), Hit{});
  }
  static bool finished(std::uint32_t) { return false; }
  HWY_INLINE float limit(std::uint32_t i) const { return hits_[i].t < rays_[i].t_far ? hits_[i].t : rays_[i].t_far; }
  void alone(std::uint32_t i) { single_.closest(level_, rays_[i], InstanceLeaves::first_instance, hits_[i], nullptr); }

  void enter(const InstanceLeaves& leaves, const Layout& bottom, std::span<const InstanceVisit> together) {
    if (together.size() < least_together) {
      for (const InstanceVisit& visit : together) {
        const InstanceLeaf& leaf = leaves.instances[visit.leaf];
        bottom.closest_below(object_ray(leaf.world_to_object, rays_[visit.ray]), leaf.instance, hits_[visit.ray],
                             nullptr);
      }
      return;
    }
    for (std::size_t v = 0; v < together.size(); ++v) {
      Ray ray = object_ray(leaves.instances[together[v].leaf].world_to_object, rays_[together[v].ray]);
      ray.t_far = limit(together[v].ray);
      object_rays_[v] = ray;
    }
    bottom.closest_hits({object_rays_, together.size()}, {object_hits_, together.size()});
    for (std::size_t v = 0; v < together.size(); ++v) {
      Hit hit = object_hits_[v];
      if (!hit.valid()) continue;
      hit.instance = leaves.instances[together[v].leaf].instance;
      Hit& best = hits_[together[v].ray];
      if (wins(hit.t, hit.instance, hit.primitive, best)) best = hit;
    }
  }

 private:
  const Kernels<WideNodes, InstanceLeaves>& single_;
  const Level<WideNodes, InstanceLeaves>& level_;
  std::span<Hit> all_hits_;
  const Ray* rays_ = nullptr;
  Hit* hits_ = nullptr;
  Ray object_rays_[rays_under_way];
  Hit object_hits_[rays_under_way];
};

class AnyThroughInstances {
 public:
  AnyThroughInstances(const Kernels<WideNodes, InstanceLeaves>& single, const Level<WideNodes, InstanceLeaves>& level,
                      std::span<std::uint8_t> blocked)
      : single_(single), level_(level), all_blocked_(blocked) {}

  void begin(std::span<const Ray> rays, std::size_t first) {
    rays_ = rays.data();
    blocked_ = all_blocked_.data() + first;
    std::fill_n(blocked_, rays.size(), std::uint8_t{0});
  }
  HWY_INLINE bool finished(std::uint32_t i) const { return blocked_[i] != 0; }
  HWY_INLINE float limit(std::uint32_t i) const { return rays_[i].t_far; }
  void alone(std::uint32_t i) { blocked_[i] = single_.any(level_, rays_[i], nullptr) ? 1 : 0; }

  void enter(const InstanceLeaves& leaves, const Layout& bottom, std::span<const InstanceVisit> together) {
    for (std::size_t v = 0; v < together.size(); ++v) {
      object_rays_[v] = object_ray(leaves.instances[together[v].leaf].world_to_object, rays_[together[v].ray]);
    }
    if (together.size() < least_together) {
      for (std::size_t v = 0; v < together.size(); ++v) {
        blocked_[together[v].ray] = bottom.any_below(object_rays_[v], nullptr) ? 1 : 0;
      }
      return;
    }
    bottom.any_hits({object_rays_, together.size()}, {object_blocked_, together.size()});
    for (std::size_t v = 0; v < together.size(); ++v) blocked_[together[v].ray] = object_blocked_[v];
  }

 private:
  const Kernels<WideNodes, InstanceLeaves>& single_;
  const Level<WideNodes, InstanceLeaves>& level_;
  std::span<std::uint8_t> all_blocked_;
  const Ray* rays_ = nullptr;
  std::uint8_t* blocked_ = nullptr;
  Ray object_rays_[rays_under_way];
  std::uint8_t object_blocked_[rays_under_way];
};

template <int K>
struct BatchOf {
  using LevelType = Level<WideNodes, InstanceLeaves>;

  static void closest(const LevelType& level, std::span<const Ray> rays, std::span<Hit> hits) {
    const Kernels<WideNodes, InstanceLeaves> single = wide_instance_kernels({});
    if (rays.size() < least_together || level.nodes.empty()) return single.closest_batch(level, rays, hits);
    ClosestThroughInstances query(single, level, hits);
    BatchThroughInstances<K, ClosestThroughInstances>(level, query).run(rays);
  }
  static void any(const LevelType& level, std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
    const Kernels<WideNodes, InstanceLeaves> single = wide_instance_kernels({});
    if (rays.size() < least_together || level.nodes.empty()) return single.any_batch(level, rays, blocked);
    AnyThroughInstances query(single, level, blocked);
    BatchThroughInstances<K, AnyThroughInstances>(level, query).run(rays);
  }
};

InstanceBatch instance_batch_of(std::uint32_t k) {
  switch (k) {
    case 4:
      return {BatchOf<4>::closest, BatchOf<4>::any};
    case 8:
      return {BatchOf<8>::closest, BatchOf<8>::any};
    case 16:
      return {BatchOf<16>::closest, BatchOf<16>::any};
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
  return kernels;
}

}  // namespace boxwood
#endif
