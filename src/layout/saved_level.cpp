// Levels in files: the table of the kinds there are, and what they share.
#include "layout/saved_level.h"

#include <algorithm>
#include <map>

#include "layout/saved_kind.h"

namespace boxwood {
namespace {

/// Every encoding that files can hold. A new one is a line here and a number in SavedKind.
const SavedKindEntry& entry_of(SavedKind kind) {
  static const SavedKindEntry entries[] = {saved_binary(), saved_wide(), saved_simd_wide(), saved_quantized()};
  for (const SavedKindEntry& entry : entries) {
    if (entry.kind == kind) return entry;
  }
  throw Error(fmt::format("it has a level of kind {}, which this version of the program does not read",
                          static_cast<std::uint32_t>(kind)));
}

void check_facts(const SavedFacts& facts, const TraceOptions& trace) {
  if (facts.instances > 1 || facts.cull > 1 || facts.out_of_cache > 1 || (facts.cull != 0) != trace.cull ||
      facts.leaf_forms > (tight_leaves | named_leaves) ||
      ((facts.vertices | facts.leaf_forms) != 0 && facts.kind != SavedKind::quantized) ||
      std::ranges::any_of(facts.zeros, [](std::uint64_t word) { return word != 0; })) {
    throw Error("it has a level with flags that mean nothing");
  }
  if (!(std::isfinite(facts.reach) && facts.reach >= 0 && std::isfinite(facts.gain) && facts.gain > 0)) {
    throw Error("it has a level without a bound on its coordinates");
  }
}

std::string find_bad_leaf(const SavedLevel& level) {
  std::uint32_t number = 0;
  const auto is_bad = [&](std::uint32_t primitive) {
    ++number;
    return primitive >= level.facts.primitives;
  };
  if (level.facts.instances) {
    for (const SavedInstance& instance : elements_of<SavedInstance>(level.leaves, "instances")) {
      if (is_bad(instance.instance) || instance.bottom >= level.bottoms.size() || instance.zero != 0) {
        return fmt::format("entry {} of its leaves names an instance or a structure that it does not have", number - 1);
      }
    }
    return {};
  }
  if (level.facts.kind == SavedKind::simd_wide || level.facts.kind == SavedKind::quantized) return {};
  for (const LeafTriangle& triangle : elements_of<LeafTriangle>(level.leaves, "triangles")) {
    if (is_bad(triangle.primitive)) {
      return fmt::format("entry {} of its leaves names triangle {} of {}", number - 1, triangle.primitive,
                         level.facts.primitives);
    }
  }
  return {};
}

}  // namespace

std::string find_damage(const SavedLevel& level, const TraceOptions& trace) try {
  const SavedKindEntry& entry = entry_of(level.facts.kind);  // first: what facts mean is up to the kind
  check_facts(level.facts, trace);
  if (std::string damage = find_bad_leaf(level); !damage.empty()) return damage;
  return entry.damage_in(level);
} catch (const Error& error) {
  return error.what();
}

std::shared_ptr<const Layout> layout_of(const SavedLevel& level, const TraceOptions& trace) {
  const SavedKindEntry& entry = entry_of(level.facts.kind);
  check_facts(level.facts, trace);
  return entry.restore(level, trace);
}

Box bounds_of(const SavedLevel& level) { return entry_of(level.facts.kind).bounds(level); }

void save_leaves(const TriangleLeaves& leaves, SavedLevel& out) {
  for (const LeafTriangle& triangle : leaves.triangles) {
    out.facts.primitives = std::max(out.facts.primitives, triangle.primitive + 1);
  }
  out.leaves = std::as_bytes(std::span(leaves.triangles));
}

void save_leaves(const InstanceLeaves& leaves, SavedLevel& out) {
  out.facts.instances = 1;
  out.bottoms = leaves.bottoms;
  const auto saved = std::make_shared<std::vector<SavedInstance>>();
  std::map<const Layout*, std::uint32_t> numbers;
  for (const auto& bottom : leaves.bottoms) numbers.emplace(bottom.get(), static_cast<std::uint32_t>(numbers.size()));
  for (const InstanceLeaf& leaf : leaves.instances) {
    out.facts.primitives = std::max(out.facts.primitives, leaf.instance + 1);
    saved->push_back({leaf.world_to_object, numbers.at(leaf.bottom), leaf.instance, ~leaf.mask});
  }
  out.leaves = std::as_bytes(std::span(*saved));
  out.owner = saved;
}

std::size_t leaf_entries(const SavedLevel& level) {
  if (level.facts.instances) return elements_of<SavedInstance>(level.leaves, "instances").size();
  return elements_of<LeafTriangle>(level.leaves, "triangles").size();
}

TriangleLeaves triangle_leaves(const SavedLevel& level) {
  const auto triangles = elements_of<LeafTriangle>(level.leaves, "triangles");
  return {{triangles.begin(), triangles.end()}};
}

InstanceLeaves instance_leaves(const SavedLevel& level) {
  InstanceLeaves leaves;
  leaves.bottoms = level.bottoms;
  for (const SavedInstance& saved : elements_of<SavedInstance>(level.leaves, "instances")) {
    // Checked at any level of trust: there are few, and a wrong one would be a pointer.
    if (saved.bottom >= leaves.bottoms.size()) {
      throw Error(fmt::format("instance {} places a structure that it does not have", saved.instance));
    }
    leaves.instances.push_back(
        {saved.world_to_object, leaves.bottoms[saved.bottom].get(), saved.instance, ~saved.hidden_from});
  }
  return leaves;
}

}  // namespace boxwood
