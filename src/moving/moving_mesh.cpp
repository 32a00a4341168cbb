#include "moving/moving_mesh.h"

#include <algorithm>
#include <atomic>

#include "moving/rebuild_parts.h"
#include "recipe/stage.h"
#include "structure/mesh_geometry.h"
#include "tree/statistics.h"

namespace boxwood {
namespace {

/// Enough to tell good parts from bad ones and to keep threads busy.
constexpr std::uint32_t wanted_parts = 256, least_part = 64;
constexpr double worst_share = 0.125;

std::uint32_t arity_of(const Recipe& recipe) {
  for (const StageCall& call : recipe.stages()) {
    if (call.stage->kind == StageKind::layout) return std::max(2u, call.stage->arity(call.options));
  }
  return 2;
}

}  // namespace

MovingMesh::MovingMesh(const Scene& scene, std::uint32_t mesh, const Recipe& recipe)
    : scene_(scene), number_(mesh), pipeline_(recipe), arity_(arity_of(recipe)) {
  build();
}

std::string MovingMesh::why_no_refit() const {
  if (!tree_.clipped_leaves) return {};
  return "its tree cuts triangles into pieces, each in a box of its own, and where pieces go when a triangle moves is "
         "not known; take a builder that does not split triangles, such as 'ploc' or 'sweep'";
}

double MovingMesh::sah_cost() const { return tree_.clipped_leaves ? boxwood::sah_cost(tree_) : accounts_.cost(); }

MotionQuality MovingMesh::quality() const {
  return {accounts_.cost(), accounts_.cost_when_built(), sibling_overlap(tree_), overlap_when_built_};
}

void MovingMesh::build() {
  const MeshGeometry geometry(mesh());
  LargeVector<Reference> references = geometry.references();
  left_out_.clear();
  if (references.size() < mesh().triangles.size()) {
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < mesh().triangles.size(); ++i) {
      if (next < references.size() && references[next].primitive == i) {
        ++next;
      } else {
        left_out_.push_back(i);
      }
    }
  }
  tree_ = pipeline_.mesh_tree({std::move(references), &geometry, nullptr});
  encode();
  if (!tree_.clipped_leaves) start_parts();
}

void MovingMesh::encode() {
  Contents contents;
  contents.mesh = &mesh();
  layout_.reset();
  layout_ = pipeline_.encode(tree_, contents);
}

void MovingMesh::start_parts() {
  const auto all = static_cast<std::uint32_t>(tree_.references.size());
  const std::uint32_t most = std::max(least_part, all / wanted_parts);
  parts_ = cut_tree(tree_, [&](std::uint32_t references, std::uint32_t) { return references <= most; });
  part_of_.assign(mesh().triangles.size(), 0);
  references_.clear();
  for (std::uint32_t p = 0; p < parts_.parts.size(); ++p) {
    const TreeParts::Part& part = parts_.parts[p];
    references_.push_back(part.references);
    for (std::uint32_t i = part.begin; i < part.end; ++i) {
      const Tree::Node& node = tree_.nodes[parts_.order[i]];
      if (!node.is_leaf()) continue;
      for (std::uint32_t r = 0; r < node.count; ++r) part_of_[tree_.references[node.first + r]] = p;
    }
  }
  accounts_.start(part_costs(tree_, parts_), areas(), references_);
  overlap_when_built_ = sibling_overlap(tree_);
}

/// The same parts in a tree that was put together anew.
void MovingMesh::find_parts() {
  parts_ = cut_tree(
      tree_, [&](std::uint32_t references, std::uint32_t first) { return references == references_[part_of_[first]]; });
  std::vector<TreeParts::Part> sorted(parts_.parts.size());
  for (const TreeParts::Part& part : parts_.parts) {
    std::uint32_t node = part.root;
    while (!tree_.nodes[node].is_leaf()) node = tree_.nodes[node].first;
    sorted[part_of_[tree_.references[tree_.nodes[node].first]]] = part;
  }
  parts_.parts = std::move(sorted);
}

std::vector<double> MovingMesh::areas() const {
  std::vector<double> out;
  for (const TreeParts::Part& part : parts_.parts) out.push_back(box_area(tree_.nodes[part.root].bounds));
  out.push_back(box_area(bounds()));
  return out;
}

Box MovingMesh::box_of(std::uint32_t triangle) const {
  Box box;
  for (const std::uint32_t vertex : mesh().triangles[triangle]) box.grow(mesh().positions[vertex]);
  return box;
}

bool MovingMesh::some_come_back() const {
  return std::ranges::any_of(left_out_, [&](std::uint32_t triangle) { return is_usable(mesh(), triangle); });
}

/// False when a triangle cannot be used where it is now.
bool MovingMesh::refit_tree(PartCosts& costs) {
  std::atomic<bool> usable = true;
  costs = refit(tree_, parts_, [&](std::span<const std::uint32_t> triangles, Box& box) {
    for (const std::uint32_t triangle : triangles) {
      if (!is_usable(mesh(), triangle)) usable.store(false, std::memory_order_relaxed);
      box.grow(box_of(triangle));
    }
  });
  return usable;
}

MovingMesh::Update MovingMesh::update(const MotionPolicy& policy) {
  const auto all_anew = [&](std::string reason = {}) {
    build();
    return Update{Done::rebuilt, triangles(), std::move(reason)};
  };
  if (policy.rebuild == Rebuild::all) return all_anew();
  if (std::string reason = why_no_refit(); !reason.empty()) return all_anew(std::move(reason));
  if (some_come_back()) return all_anew("triangles that could not be used before can be used now");
  PartCosts costs;
  if (!refit_tree(costs)) return all_anew("some of its triangles have no area or are not finite where they are now");
  accounts_.charge(costs, areas(), policy);
  if (tree_.empty()) {
    encode_in_place();
    return {};
  }

  DueParts due;
  if (policy.rebuild == Rebuild::when_it_pays) due = accounts_.due(policy);
  if (policy.rebuild == Rebuild::worst_parts) due = accounts_.worst(worst_share);
  if (due.all) return all_anew();
  if (due.parts.empty() && !due.above) {
    encode_in_place();
    return {};
  }
  if (!rebuild(due)) return all_anew();
  Update out{Done::rebuilt_in_part, 0, {}};
  for (const std::uint32_t p : due.parts) out.rebuilt_triangles += references_[p];
  return out;
}

/// False where the recipe's builder cannot build the nodes above the parts, because it asks for triangles.
bool MovingMesh::rebuild(const DueParts& due) {
  const MeshGeometry geometry(mesh());
  const auto build_part = [&](LargeVector<Reference> references, bool of_triangles) {
    return pipeline_.mesh_tree({std::move(references), of_triangles ? &geometry : nullptr, nullptr});
  };
  try {
    tree_ = rebuild_parts(tree_, parts_, due, arity_, build_part, [&](std::uint32_t i) { return box_of(i); });
  } catch (const UsageError&) {
    return false;
  }
  find_parts();
  accounts_.settle(due, part_costs(tree_, parts_), areas());
  encode();
  return true;
}

void MovingMesh::encode_in_place() {
  // Nobody else has it, and it was not made const.
  if (layout_.use_count() == 1 && std::const_pointer_cast<Layout>(layout_)->refit(tree_, mesh())) return;
  encode();
}

}  // namespace boxwood
