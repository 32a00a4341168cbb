#include "structure/pipeline.h"

#include <fmt/format.h>

#include "layout/precise/precise_level.h"
#include "structure/mesh_geometry.h"

namespace boxwood {

Pipeline::Pipeline(const Recipe& recipe) {
  for (const StageCall& call : recipe.stages()) {
    switch (call.stage->kind) {
      case StageKind::builder:
        builder_ = &call;
        break;
      case StageKind::refinement:
        refinements_.push_back(&call);
        break;
      case StageKind::layout:
        layout_ = &call;
        break;
      case StageKind::trace:
        trace_ = std::any_cast<const TraceOptions&>(call.options);
        break;
      case StageKind::peer:
        throw UsageError(
            fmt::format("'{}' is a peer: it builds by itself and its tree cannot be seen", call.stage->name));
    }
  }
}

Tree Pipeline::tree(BuildInput input) const {
  const RefineContext context{input.geometry, input.use};
  Tree tree = builder_->stage->build(builder_->options, std::move(input));
  for (const StageCall* call : refinements_) tree = call->stage->refine(call->options, std::move(tree), context);
  return tree;
}

Tree Pipeline::mesh_tree(BuildInput input) const {
  Tree out = tree(std::move(input));
  if (layout_ && layout_->stage->arrange) layout_->stage->arrange(layout_->options, trace_, out);
  return out;
}

float Pipeline::references_per_instance() const {
  for (const StageCall* call : refinements_) {
    if (call->stage->references_per_instance) return call->stage->references_per_instance(call->options);
  }
  return 1;
}

void Pipeline::check_places_whole() const {
  if (references_per_instance() == 1) return;
  throw UsageError(
      "'rebraid' opens the instances of a scene while it is built; structures that are placed or move stay whole, so "
      "leave it out here");
}

std::shared_ptr<const Layout> Pipeline::encode(Tree tree, const Contents& contents) const {
  if (trace_.precision == Precision::double_test) return encode_precise(std::move(tree), contents);
  return layout_->stage->encode(layout_->options, std::move(tree), contents, trace_);
}

Tree tree_of(const Mesh& mesh, const Recipe& recipe, const KnownUse* use) {
  const MeshGeometry geometry(mesh);
  return Pipeline(recipe).mesh_tree({geometry.references(), &geometry, use});
}

}  // namespace boxwood
