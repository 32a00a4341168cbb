#include <algorithm>

#include "layout/encode.h"
#include "layout/saved_kind.h"
#include "layout/wide/wide_nodes.h"

namespace boxwood {
namespace {

Kernels<WideNodes, TriangleLeaves> kernels_of(const Level<WideNodes, TriangleLeaves>&, const TraceOptions& trace) {
  return wide_triangle_kernels(trace);
}
Kernels<WideNodes, InstanceLeaves> kernels_of(const Level<WideNodes, InstanceLeaves>& level,
                                              const TraceOptions& trace) {
  return wide_instance_kernels_of(level.nodes.k, trace);
}

WideNodes saved_wide_nodes(const SavedLevel& level) {
  const SavedFacts& facts = level.facts;
  if (facts.children < 2 || facts.children > 256) {
    throw Error(fmt::format("it has nodes of {} children", facts.children));
  }
  const auto saved = elements_of<float>(level.nodes, "nodes");
  WideNodes nodes{facts.children, facts.root_box, facts.root, {saved.begin(), saved.end()}};
  if (nodes.memory.size() % (8 * std::size_t{nodes.k}) != 0) throw Error("its nodes end within one");
  return nodes;
}

/// Walks the inner nodes, which stand in depth-first order, so that each is reached when its turn has come.
class WideCheck {
 public:
  WideCheck(const SavedLevel& level, const WideNodes& nodes)
      : nodes_(nodes), leaves_(leaf_entries(level)), inner_(nodes.memory.size() / (8 * std::size_t{nodes.k})) {}

  std::string run() {
    if (!is_sound(nodes_.root_box)) return "its root has no proper box";
    if (!enter(nodes_.root, 1)) return "its root leads nowhere";
    for (std::uint32_t next = 0; !pending_.empty(); ++next) {
      const Pending node = pending_.back();
      pending_.pop_back();
      if (node.first != next) return fmt::format("node {} is not where its parent says", next);
      const std::uint32_t need = node.need + node.count - 1;
      if (need > stack_entries) return "it is deeper than any walk can go";
      const std::size_t begin = pending_.size();
      for (std::uint32_t lane = 0; lane < node.count; ++lane) {
        if (!is_sound(box(next, lane)) || !enter(link(next, lane), need)) {
          return fmt::format("child {} of node {} leads nowhere", lane, next);
        }
      }
      std::reverse(pending_.begin() + static_cast<std::ptrdiff_t>(begin), pending_.end());
      reached_ = next + 1;
    }
    return reached_ == inner_ ? std::string() : fmt::format("its nodes from {} on belong to no tree", reached_);
  }

 private:
  struct Pending {
    std::uint32_t first, count, need;
  };

  Box box(std::uint32_t node, std::uint32_t lane) const {
    const float* planes = nodes_.memory.data() + node * (8 * std::size_t{nodes_.k}) + lane;
    Box out;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      out.lower[axis] = planes[axis * nodes_.k];
      out.upper[axis] = planes[(axis + 3) * nodes_.k];
    }
    return out;
  }
  Link link(std::uint32_t node, std::uint32_t lane) const {
    Link out;
    std::memcpy(
        static_cast<void*>(&out),
        nodes_.memory.data() + node * (8 * std::size_t{nodes_.k}) + 6 * std::size_t{nodes_.k} + 2 * std::size_t{lane},
        sizeof out);
    return out;
  }
  bool enter(const Link& link, std::uint32_t need) {
    if (link.leaf) return is_sound_leaf(link, leaves_);
    if (link.first >= inner_ || link.count < 2 || link.count > nodes_.k || link.unused) return false;
    pending_.push_back({link.first, link.count, need});
    return true;
  }

  const WideNodes& nodes_;
  std::size_t leaves_, inner_;
  std::vector<Pending> pending_;
  std::uint32_t reached_ = 0;
};

std::string wide_damage(const SavedLevel& level) {
  const WideNodes nodes = saved_wide_nodes(level);
  if (nodes.empty()) return nodes.memory.empty() ? std::string() : "it has nodes but no root";
  return WideCheck(level, nodes).run();
}

std::shared_ptr<const Layout> restore_wide(const SavedLevel& level, const TraceOptions& trace) {
  return kernel_layout_of(saved_wide_nodes(level), level, trace,
                          [](const auto& l, const TraceOptions& t) { return kernels_of(l, t); });
}

Box wide_bounds(const SavedLevel& level) { return level.facts.root.count == 0 ? Box{} : level.facts.root_box; }

}  // namespace

SavedKindEntry saved_wide() { return {SavedKind::wide, wide_damage, restore_wide, wide_bounds}; }

}  // namespace boxwood
