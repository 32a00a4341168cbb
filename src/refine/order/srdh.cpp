#include <algorithm>

#include "build/hit_lists.h"
#include "refine/order/rules.h"
#include "tree/reference_slots.h"

namespace boxwood {
namespace {

/// What a ray does at a node with two children.
struct Visit {
  bool meets[2], hits[2];
  bool second_is_nearer;
};

class SrdhOrder {
 public:
  SrdhOrder(const Tree& tree, const SegmentHits& lists) : tree_(tree), rays_(lists.rays), slots_(tree) {
    for (std::uint32_t ray = 0; ray < rays_.size(); ++ray) {
      begin_.push_back(hit_slots_.size());
      for (const std::uint32_t primitive : lists.of(ray)) add_slots(primitive);
      std::sort(hit_slots_.begin() + static_cast<std::ptrdiff_t>(begin_.back()), hit_slots_.end());
    }
    begin_.push_back(hit_slots_.size());
  }

  Orders run() {
    Orders orders(tree_.nodes.size(), ChildOrderChoice::as_it_is);
    std::vector<std::uint32_t> all;
    for (std::uint32_t ray = 0; ray < rays_.size(); ++ray) {
      if (rays_[ray].meets(tree_.nodes[0].bounds)) all.push_back(ray);
    }
    std::vector<Pending> stack;
    stack.push_back({0, std::move(all)});
    while (!stack.empty()) {
      const Pending pending = std::move(stack.back());
      stack.pop_back();
      if (!pending.rays.empty() && !tree_.nodes[pending.node].is_leaf()) orders[pending.node] = decide(pending, stack);
    }
    return orders;
  }

 private:
  struct Pending {
    std::uint32_t node;
    std::vector<std::uint32_t> rays;
  };

  void add_slots(std::uint32_t primitive) {
    const auto& all = slots_.by_primitive();
    auto at = std::ranges::lower_bound(all, ReferenceSlots::Slot{primitive, 0});
    for (; at != all.end() && at->primitive == primitive; ++at) hit_slots_.push_back(at->slot);
  }

  bool hits(std::uint32_t ray, std::uint32_t node) const {
    const auto begin = hit_slots_.begin() + static_cast<std::ptrdiff_t>(begin_[ray]),
               end = hit_slots_.begin() + static_cast<std::ptrdiff_t>(begin_[ray + 1]);
    const auto first = std::lower_bound(begin, end, slots_.begin(node));
    return first != end && *first < slots_.end(node);
  }

  Visit visit(std::uint32_t ray, std::uint32_t first_child) const {
    Visit visit{};
    float near[2] = {};
    for (std::uint32_t c = 0; c < 2; ++c) {
      visit.meets[c] = rays_[ray].meets(tree_.nodes[first_child + c].bounds, near[c]);
      visit.hits[c] = visit.meets[c] && hits(ray, first_child + c);
    }
    visit.second_is_nearer = near[1] < near[0];
    return visit;
  }

  /// Prices the orders, picks the cheapest, and sends each ray to the children that it then visits.
  ChildOrderChoice decide(const Pending& pending, std::vector<Pending>& stack) const {
    const std::uint32_t first_child = tree_.nodes[pending.node].first;
    const double sizes[2] = {static_cast<double>(slots_.end(first_child) - slots_.begin(first_child)),
                             static_cast<double>(slots_.end(first_child + 1) - slots_.begin(first_child + 1))};
    const auto price = [&](const Visit& v, unsigned first) {
      const unsigned second = 1 - first;
      return (v.meets[first] ? sizes[first] : 0) + (v.meets[second] && !v.hits[first] ? sizes[second] : 0);
    };
    std::vector<Visit> visits;
    double as_stored = 0, swapped = 0, near_first = 0;
    for (const std::uint32_t ray : pending.rays) {
      const Visit v = visit(ray, first_child);
      as_stored += price(v, 0);
      swapped += price(v, 1);
      near_first += price(v, v.second_is_nearer ? 1 : 0);
      visits.push_back(v);
    }
    const double least = std::min({near_first, as_stored, swapped});
    Pending children[2] = {{first_child, {}}, {first_child + 1, {}}};
    for (std::size_t i = 0; i < visits.size(); ++i) {
      const Visit& v = visits[i];
      const unsigned near = v.second_is_nearer ? 1 : 0;
      const unsigned first = least == near_first ? near : least == as_stored ? 0 : 1;
      if (v.meets[first]) children[first].rays.push_back(pending.rays[i]);
      if (v.meets[1 - first] && !v.hits[first]) children[1 - first].rays.push_back(pending.rays[i]);
    }
    for (Pending& child : children) stack.push_back(std::move(child));
    if (least == near_first) return ChildOrderChoice::as_it_is;
    return least == as_stored ? ChildOrderChoice::as_stored : ChildOrderChoice::swapped;
  }

  const Tree& tree_;
  const std::vector<Segment>& rays_;
  ReferenceSlots slots_;
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> hit_slots_;  // by ray, ascending
};

}  // namespace

Orders order_by_srdh(const Tree& tree, const Geometry& geometry, const KnownUse& use) {
  const SegmentHits lists = hit_lists(tree, geometry, use);
  return SrdhOrder(tree, lists).run();
}

}  // namespace boxwood
