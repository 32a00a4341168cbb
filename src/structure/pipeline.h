#pragma once
#include <memory>
#include <vector>

#include "boxwood/recipe.h"
#include "build/build_input.h"
#include "recipe/stage.h"
#include "tree/tree.h"

namespace boxwood {

/// The stages of a recipe that is not a peer, sorted by what they do. Refers to the recipe.
class Pipeline {
 public:
  explicit Pipeline(const Recipe& recipe);

  /// Builder and refinements.
  Tree tree(BuildInput input) const;
  /// The same of a mesh's triangles, arranged as the layout wants it.
  Tree mesh_tree(BuildInput input) const;
  /// How many references to parts of meshes there may be per instance; 1: meshes are placed whole.
  float references_per_instance() const;
  /// Throws UsageError unless that is 1: for those who place what is built already, or moves.
  void check_places_whole() const;
  std::shared_ptr<const Layout> encode(Tree tree, const Contents& contents) const;

 private:
  const StageCall* builder_ = nullptr;
  std::vector<const StageCall*> refinements_;
  const StageCall* layout_ = nullptr;
  TraceOptions trace_;
};

/// The tree that a recipe lays out for one mesh: its builder and refinements, without the layout. Throws UsageError for
/// a peer, whose trees cannot be seen. `use`: null when nothing is known of the rays to come.
Tree tree_of(const Mesh& mesh, const Recipe& recipe, const KnownUse* use = nullptr);

}  // namespace boxwood
