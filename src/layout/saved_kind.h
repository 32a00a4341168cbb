#pragma once
// What a layout brings so that files can hold it.
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "boxwood/error.h"
#include "layout/kernel_layout.h"
#include "layout/saved_level.h"

namespace boxwood {

/// One line of the table in saved_level.cpp.
struct SavedKindEntry {
  SavedKind kind;
  std::string (*damage_in)(const SavedLevel& level);
  std::shared_ptr<const Layout> (*restore)(const SavedLevel& level, const TraceOptions& trace);
  Box (*bounds)(const SavedLevel& level);
};

SavedKindEntry saved_binary();
SavedKindEntry saved_wide();
SavedKindEntry saved_simd_wide();
SavedKindEntry saved_quantized();

/// Bytes of a file as the elements they are. Throws Error when they are no whole number of them.
template <class T>
std::span<const T> elements_of(std::span<const std::byte> bytes, const char* what) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (bytes.size() % sizeof(T) != 0) throw Error(fmt::format("its {} end within an element", what));
  return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
}

/// Whether a box could be that of a node: finite and not empty.
inline bool is_sound(const Box& box) {
  constexpr float most = std::numeric_limits<float>::max();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(box.lower[axis] >= -most && box.lower[axis] <= box.upper[axis] && box.upper[axis] <= most)) return false;
  }
  return true;
}

/// Whether a link to a leaf names some of `leaves` entries.
inline bool is_sound_leaf(const Link& link, std::size_t leaves) {
  return link.count >= 1 && std::size_t{link.first} + link.count <= leaves && link.unused == 0;
}

/// Copies of the leaves of a level.
TriangleLeaves triangle_leaves(const SavedLevel& level);
InstanceLeaves instance_leaves(const SavedLevel& level);
/// Entries in the leaf array. Throws Error when it ends within one.
std::size_t leaf_entries(const SavedLevel& level);

/// `kernels_of(level, trace)` gives the kernels for a level of either content.
template <class Nodes, class KernelsOf>
std::shared_ptr<const Layout> kernel_layout_of(Nodes nodes, const SavedLevel& saved, const TraceOptions& trace,
                                               const KernelsOf& kernels_of) {
  const auto finish = [&](auto leaves) -> std::shared_ptr<const Layout> {
    using Leaves = decltype(leaves);
    Level<Nodes, Leaves> level{
        std::move(nodes), std::move(leaves), {saved.facts.reach, saved.facts.gain}, saved.facts.cull != 0};
    const Kernels<Nodes, Leaves> kernels = kernels_of(level, trace);
    return std::make_shared<KernelLayout<Nodes, Leaves>>(std::move(level), kernels);
  };
  if (saved.facts.instances) return finish(instance_leaves(saved));
  return finish(triangle_leaves(saved));
}

}  // namespace boxwood
