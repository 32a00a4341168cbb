#pragma once
#include <any>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "boxwood/scene.h"
#include "build/build_input.h"
#include "layout/layout.h"
#include "layout/trace_options.h"
#include "options/options.h"
#include "tree/tree.h"

namespace boxwood {

enum class StageKind { builder, refinement, layout, trace, peer };

/// What a layout encodes: exactly one of the two is set. A bottom level has triangles of `mesh` at its leaves; a top
/// level has instances, whose own structures are `bottoms[i]` (shared by all instances of a mesh).
struct Contents {
  const Mesh* mesh = nullptr;
  std::span<const Instance> instances;  ///< of which `mesh` is an index into `bottoms`
  std::span<const std::shared_ptr<const Layout>> bottoms;
  std::span<const std::uint32_t> numbers;  ///< of the first instance in each; empty: each is one, by its place
};

using BuilderFunction = std::function<Tree(const std::any& options, BuildInput input)>;

/// What a refinement may know besides the tree; the same as a builder.
struct RefineContext {
  const Geometry* geometry = nullptr;  ///< null when only boxes are known
  const KnownUse* use = nullptr;       ///< null when nothing is known of the rays to come
};

class RefinementFunction {
 public:
  RefinementFunction() = default;
  RefinementFunction(std::function<Tree(const std::any& options, Tree tree, const RefineContext&)> function)
      : function_(std::move(function)) {}
  Tree operator()(const std::any& options, Tree tree, const RefineContext& context = {}) const {
    tree.cells = {};  // of the nodes as they were
    return function_(options, std::move(tree), context);
  }

 private:
  std::function<Tree(const std::any&, Tree, const RefineContext&)> function_;
};

using LayoutFunction = std::function<std::shared_ptr<const Layout>(const std::any& options, Tree tree, const Contents&,
                                                                   const TraceOptions&)>;
/// A peer takes the scene whole and brings its own builder and kernels.
using PeerFunction = std::function<std::shared_ptr<const Layout>(const std::any& options, const Scene& scene)>;

/// One registry line: a name, where it comes from, its options, and what it does.
struct Stage {
  StageKind kind;
  std::string name;
  std::string summary;
  std::string source;  ///< paper or study
  std::any defaults;   ///< the options struct as it is when nothing is said
  std::vector<Option> options;

  BuilderFunction build;
  RefinementFunction refine;
  /// Of a refinement of how instances are placed: how many references to their parts there may be for each.
  std::function<float(const std::any& options)> references_per_instance;
  LayoutFunction encode;
  /// Of a layout: puts the children of a mesh's tree into the order it wants them in. Not set: any will do.
  std::function<void(const std::any& options, const TraceOptions& trace, Tree& tree)> arrange;
  PeerFunction trace_peer;
  /// Most children a node can have: of what a builder makes, of what a layout encodes. A refinement that does not set
  /// it keeps the arity it finds.
  std::function<std::uint32_t(const std::any& options)> arity;
  /// Whether the stage must know which rays will be traced. Not set: it need not.
  std::function<bool(const std::any& options)> needs_use;
  /// Of a builder: its trees tell the cells of an octree (Tree::cells). Of a layout: it encodes those.
  bool cells = false;
  /// Of a layout: custom primitives and triangles in double precision can take its place, in wide nodes (layout/custom,
  /// layout/precise).
  bool custom = false;
};

/// A stage with the options a recipe gave it.
struct StageCall {
  const Stage* stage;
  std::any options;
};

/// A named recipe.
struct Preset {
  std::string name;
  std::string text;
  std::string summary;
  std::string text_avx512 = {};  ///< where registers have 512 bits; empty: the same
};

/// What a preset stands for on this machine.
const std::string& text_here(const Preset& preset);

/// Every stage there is, in the order in which `boxwood recipes` prints them. A new stage is one line here.
const std::vector<Stage>& stages();
const std::vector<Preset>& presets();

/// The part that all kinds of stages share.
template <class Options>
Stage describe(StageKind kind, std::string name, std::string summary, std::string source,
               OptionsOf<Options> description, std::uint32_t (*arity)(const Options&)) {
  Stage stage;
  stage.kind = kind;
  stage.name = std::move(name);
  stage.summary = std::move(summary);
  stage.source = std::move(source);
  stage.defaults = Options{};
  stage.options = description.take();
  if (arity) stage.arity = [arity](const std::any& options) { return arity(std::any_cast<const Options&>(options)); };
  return stage;
}

// Wrappers for functions on a typed options struct, one per kind.

template <class Options>
Stage builder_stage(std::string name, std::string summary, std::string source, OptionsOf<Options> description,
                    Tree (*build)(const Options&, BuildInput), std::uint32_t (*arity)(const Options&)) {
  Stage stage = describe(StageKind::builder, std::move(name), std::move(summary), std::move(source),
                         std::move(description), arity);
  stage.build = [build](const std::any& options, BuildInput input) {
    return build(std::any_cast<const Options&>(options), std::move(input));
  };
  return stage;
}

template <class Options>
Stage refinement_stage(std::string name, std::string summary, std::string source, OptionsOf<Options> description,
                       Tree (*refine)(const Options&, Tree, const RefineContext&),
                       std::uint32_t (*arity)(const Options&)) {
  Stage stage = describe(StageKind::refinement, std::move(name), std::move(summary), std::move(source),
                         std::move(description), arity);
  stage.refine = {[refine](const std::any& options, Tree tree, const RefineContext& context) {
    return refine(std::any_cast<const Options&>(options), std::move(tree), context);
  }};
  return stage;
}

/// Of one that looks at nothing but the tree.
template <class Options>
Stage refinement_stage(std::string name, std::string summary, std::string source, OptionsOf<Options> description,
                       Tree (*refine)(const Options&, Tree), std::uint32_t (*arity)(const Options&)) {
  Stage stage = describe(StageKind::refinement, std::move(name), std::move(summary), std::move(source),
                         std::move(description), arity);
  stage.refine = {[refine](const std::any& options, Tree tree, const RefineContext&) {
    return refine(std::any_cast<const Options&>(options), std::move(tree));
  }};
  return stage;
}

template <class Options>
Stage layout_stage(std::string name, std::string summary, std::string source, OptionsOf<Options> description,
                   std::shared_ptr<const Layout> (*encode)(const Options&, Tree, const Contents&, const TraceOptions&),
                   std::uint32_t (*arity)(const Options&)) {
  Stage stage = describe(StageKind::layout, std::move(name), std::move(summary), std::move(source),
                         std::move(description), arity);
  stage.encode = [encode](const std::any& options, Tree tree, const Contents& contents, const TraceOptions& trace) {
    return encode(std::any_cast<const Options&>(options), std::move(tree), contents, trace);
  };
  return stage;
}

}  // namespace boxwood
