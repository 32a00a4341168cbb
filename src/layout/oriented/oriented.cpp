// Boxes in a frame of their own where that makes them smaller: oriented bounding boxes as in Gottschalk, Lin, Manocha
// 1996, "OBBTree", with one frame for all children of a node, so that a ray is turned once per visit. What the PCA
// study proposes as its future work. Nodes that gain little keep the world's axes.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "boxwood/error.h"
#include "layout/encode.h"
#include "layout/encode_level.h"
#include "layout/oriented/frames.h"
#include "layout/oriented/oriented_nodes.h"
#include "layout/stages.h"

namespace boxwood {
namespace {

struct OrientedOptions {
  std::uint32_t k = 2;
  float area = 0.7f;
};

/// Where each inner node begins in memory, in units: depth-first, turned nodes being longer.
std::vector<std::uint32_t> places_of(const Tree& tree, const std::optional<Frames>& frames, std::uint32_t k,
                                     std::uint64_t& units) {
  const std::vector<std::uint32_t> order = depth_first_places(tree, true);
  std::vector<std::uint32_t> by_place;
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    if (tree.nodes[i].is_leaf()) continue;
    if (by_place.size() <= order[i]) by_place.resize(std::size_t{order[i]} + 1);
    by_place[order[i]] = i;
  }
  std::vector<std::uint32_t> places(tree.nodes.size());
  units = 0;
  for (const std::uint32_t node : by_place) {
    places[node] = static_cast<std::uint32_t>(units);
    units += (8 * std::size_t{k} + (frames && frames->turned(node) ? frame_floats : 0)) / oriented_unit;
  }
  // Links have a bit less for places, as have slots, which count links, half a unit each.
  if (units >> 31 != 0) {
    throw Error(
        fmt::format("'oriented({})' has no room for a tree of {} nodes; use larger leaves", k, tree.nodes.size()));
  }
  return places;
}

class Encoder {
 public:
  Encoder(const Tree& tree, const Mesh* mesh, std::uint32_t k, float area) : tree_(tree), mesh_(mesh), k_(k) {
    if (mesh) frames_.emplace(tree, *mesh, area);
    places_ = places_of(tree, frames_, k, units_);
  }

  OrientedNodes encode() const {
    OrientedNodes out;
    out.k = k_;
    if (tree_.empty()) return out;
    out.root_box = tree_.nodes[0].bounds;
    const Vec3 far = max(max(out.root_box.lower, out.root_box.upper), max(-out.root_box.lower, -out.root_box.upper));
    out.reach = std::max({far.x, far.y, far.z});
    out.root = link(0);
    out.memory.resize(units_ * oriented_unit);
    out.turned_nodes = frames_ ? frames_->count() : 0;
    out.inner_nodes = static_cast<std::uint32_t>(
        std::ranges::count_if(tree_.nodes, [](const Tree::Node& node) { return !node.is_leaf(); }));
    tbb::parallel_for(std::size_t{0}, tree_.nodes.size(), [&](std::size_t i) {
      if (tree_.nodes[i].is_leaf()) return;
      write(static_cast<std::uint32_t>(i), out.memory.data() + std::size_t{places_[i]} * oriented_unit);
    });
    return out;
  }

 private:
  Link link(std::uint32_t node) const {
    const Tree::Node& n = tree_.nodes[node];
    const bool turned = !n.is_leaf() && frames_ && frames_->turned(node);
    const Link link = link_to(n, n.is_leaf() ? n.first : 2 * places_[node] + (turned ? 1 : 0));
    return link;
  }

  void write(std::uint32_t node, float* memory) const {
    const Tree::Node& n = tree_.nodes[node];
    const bool turned = frames_ && frames_->turned(node);
    for (std::uint32_t lane = 0; lane < n.count; ++lane) {
      const std::uint32_t child = n.first + lane;
      const Box box = turned ? turned_box(tree_, child, *mesh_, frames_->frame(node)) : tree_.nodes[child].bounds;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        memory[axis * k_ + lane] = box.lower[axis];
        memory[(axis + 3) * k_ + lane] = box.upper[axis];
      }
      const Link to_child = link(child);
      std::memcpy(memory + 6 * std::size_t{k_} + 2 * std::size_t{lane}, &to_child, sizeof to_child);
    }
    if (!turned) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::copy_n(frames_->frame(node).axis[axis], 3, memory + 8 * std::size_t{k_} + 4 * axis);
    }
  }

  const Tree& tree_;
  const Mesh* mesh_;
  std::uint32_t k_;
  std::optional<Frames> frames_;
  std::uint64_t units_ = 0;
  std::vector<std::uint32_t> places_;
};

struct ChooseOriented {
  auto operator()(const Level<OrientedNodes, TriangleLeaves>&, const TraceOptions& options) const {
    return oriented_triangle_kernels(options);
  }
  auto operator()(const Level<OrientedNodes, InstanceLeaves>&, const TraceOptions& options) const {
    return oriented_instance_kernels(options);
  }
};

std::shared_ptr<const Layout> encode(const OrientedOptions& options, Tree tree, const Contents& contents,
                                     const TraceOptions& trace) {
  // The references go to the leaves before the nodes are made, which need them to find the triangles.
  OrientedNodes nodes = encode_oriented(tree, contents.mesh, options.k, options.area);
  return encode_level(
      std::move(tree), contents, trace, [&](const Tree&) { return std::move(nodes); }, ChooseOriented{});
}

}  // namespace

OrientedNodes encode_oriented(const Tree& tree, const Mesh* mesh, std::uint32_t k, float area) {
  check_walkable(tree, k, fmt::format("oriented({})", k));
  return Encoder(tree, mesh, k, area).encode();
}

Stage oriented_stage() {
  OptionsOf<OrientedOptions> options;
  options.integer("k", &OrientedOptions::k, 2, 16, "most children per node")
      .positional()
      .real("area", &OrientedOptions::area, 0, 100,
            "a node's boxes are turned where they keep less than this part of their surface; 0: never");
  return layout_stage<OrientedOptions>("oriented", "boxes in frames of their own where those fit better",
                                       "Gottschalk, Lin, Manocha 1996; PCA study, future work", options, encode,
                                       [](const OrientedOptions& chosen) { return chosen.k; });
}

}  // namespace boxwood
