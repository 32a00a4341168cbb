// Puts the child that an any-hit ray had better visit first in front, and tells kernels to keep to it. Wide nodes are
// made binary first.
#include <algorithm>
#include <utility>

#include "boxwood/error.h"
#include "refine/order/rules.h"
#include "refine/order/stages.h"
#include "refine/reinsert/link_tree.h"

namespace boxwood {
namespace {

enum class Rule { rtsah, sato, sato_max, srdh };

struct OrderOptions {
  Rule by = Rule::rtsah;
  std::uint32_t lines = 0;
  float traversal_cost = 1;
};

Orders orders_of(const OrderOptions& options, const Tree& tree, const RefineContext& context) {
  switch (options.by) {
    case Rule::rtsah:
      return order_by_rtsah(tree, double{options.traversal_cost}, options.lines);
    case Rule::sato:
      return order_by_sato(tree, *context.geometry, AreaOf::mean);
    case Rule::sato_max:
      return order_by_sato(tree, *context.geometry, AreaOf::largest);
    case Rule::srdh:
      return order_by_srdh(tree, *context.geometry, *context.use);
  }
  return {};
}

Tree order(const OrderOptions& options, Tree tree, const RefineContext& context) {
  if (options.by == Rule::srdh && !context.use) {
    throw UsageError("order(by=srdh) must know which rays will be traced and was told nothing; set BuildOptions::use");
  }
  if (!is_binary(tree)) tree = relink(link(tree), tree);
  // Instances have no triangles of their own: what holds them keeps its order.
  if (tree.empty() || !context.geometry) return tree;
  Orders orders = orders_of(options, tree, context);
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    Tree::Node& node = tree.nodes[i];
    if (orders[i] == ChildOrderChoice::as_it_is) continue;
    node.fixed_order = 1;
    if (orders[i] == ChildOrderChoice::as_stored) continue;
    std::swap(tree.nodes[node.first], tree.nodes[node.first + 1]);
    std::swap(orders[node.first], orders[node.first + 1]);
    node.axis = Tree::mixed_axis;
  }
  return tree;
}

}  // namespace

Stage order_stage() {
  OptionsOf<OrderOptions> options;
  options
      .choice("by", &OrderOptions::by, {"rtsah", "sato", "sato-max", "srdh"},
              "surface areas; mean or largest triangle area; representative rays")
      .integer("lines", &OrderOptions::lines, 0, 4096,
               "for rtsah: lines per node that tell how many rays meet both children; 0: as if children filled it")
      .real("traversal_cost", &OrderOptions::traversal_cost, 0, 1e6f, "for rtsah: in primitive tests");
  Stage stage = refinement_stage<OrderOptions>(
      "order", "puts in front the child that a ray which any hit ends had better visit first",
      "Ize and Hansen 2011; Nah and Manocha 2014; Feltman et al. 2012", options, order,
      [](const OrderOptions&) { return 2u; });
  stage.needs_use = [](const std::any& chosen) { return std::any_cast<const OrderOptions&>(chosen).by == Rule::srdh; };
  return stage;
}

}  // namespace boxwood
