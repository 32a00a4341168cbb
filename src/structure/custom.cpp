// Structures over primitives of the caller's own kind.
#include "boxwood/custom.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "layout/custom/custom_layout.h"
#include "recipe/capabilities.h"
#include "recipe/stage.h"
#include "structure/pipeline.h"
#include "structure/size_limits.h"
#include "structure/threads.h"
#include "tree/statistics.h"

namespace boxwood {
namespace {

void check_custom_recipe(const Recipe& recipe) {
  if (walks_wide_nodes(recipe.stages()) && precision_of(recipe.stages()) == Precision::single_test) return;
  throw UsageError(
      fmt::format("'{}' cannot trace custom primitives: they need the layout wide(k) or compressed(k) "
                  "under the default walk",
                  recipe.text()));
}

bool is_usable(const Box& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float lower = box.lower[axis], upper = box.upper[axis];
    if (!(lower >= -largest_coordinate && lower <= upper && upper <= largest_coordinate)) return false;
  }
  return true;
}

LargeVector<Reference> references_of(const CustomPrimitives& primitives, std::uint32_t count) {
  std::vector<Box> boxes(count);
  tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t i) { boxes[i] = primitives.bounds(i); });
  LargeVector<Reference> out;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (is_usable(boxes[i])) out.push_back({boxes[i].lower, i, boxes[i].upper, 0});
  }
  return out;
}

}  // namespace

Structure build(std::shared_ptr<const CustomPrimitives> primitives, const Recipe& recipe, const BuildOptions& options) {
  if (!primitives) throw UsageError("there are no primitives to build a structure over: the pointer is null");
  check_custom_recipe(recipe);
  const std::uint32_t count = primitives->size();
  check_named(count, 0);
  BuildReport report;
  std::shared_ptr<const Layout> layout;
  run_on_threads(options.threads, [&] {
    const auto begin = std::chrono::steady_clock::now();
    BuildInput input;
    input.references = references_of(*primitives, count);
    report.primitives = input.references.size();
    report.left_out = count - input.references.size();
    Tree tree = Pipeline(recipe).tree(std::move(input));
    report.nodes = tree.nodes.size();
    report.sah_cost = sah_cost(tree);
    if (!tree.empty()) report.bounds = tree.nodes[0].bounds;
    layout = encode_custom(std::move(tree), std::move(primitives));
    report.build_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  });
  report.bytes = layout->bytes();
  add_facts(report.facts, layout->facts());
  return {std::move(layout), std::move(report), recipe};
}

Structure build(std::shared_ptr<const CustomPrimitives> primitives, std::string_view recipe,
                const BuildOptions& options) {
  return build(std::move(primitives), Recipe::parse(recipe), options);
}

}  // namespace boxwood
