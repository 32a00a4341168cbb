// `boxwood inspect`: everything that is known about the trees of one recipe on one scene.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "command.h"
#include "console.h"
#include "exit_code.h"
#include "expected_view.h"
#include "report/json.h"
#include "report/number_text.h"
#include "report/table.h"
#include "report/tree_metrics_text.h"
#include "report/tree_text.h"
#include "structure/mesh_geometry.h"
#include "structure/object_use.h"
#include "structure/pipeline.h"
#include "tree/split_cost.h"
#include "tree/statistics.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

struct InspectOptions {
  CommonOptions common;
  ViewOptions view;
  std::string scene;
  std::string recipe = "default";
  std::uint32_t epo_samples = 20000;
};

constexpr std::size_t most_trees_shown = 3;  // of scenes with many meshes; JSON has them all

struct MeshTree {
  std::string mesh;
  std::uint64_t triangles = 0;
  TreeStatistics statistics;
  TreeMetrics metrics;
  double split_cost_sum = 0;
};

std::vector<MeshTree> inspect_trees(const Scene& scene, const Recipe& recipe, const ExpectedUse& use,
                                    std::uint32_t epo_samples) {
  std::vector<MeshTree> trees;
  const std::vector<Box> boxes = instance_boxes(scene);
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    check_interrupt();
    const Mesh& mesh = scene.meshes[m];
    const KnownUse known = use_of_mesh(use, scene, m, boxes);
    const Tree tree = tree_of(mesh, recipe, &known);
    trees.push_back({mesh.name, mesh.triangles.size(), statistics(tree), tree_metrics(tree, mesh, known, epo_samples),
                     split_cost_sum(tree)});
  }
  return trees;
}

double bytes_per_triangle(const BuildReport& report) {
  return report.primitives == 0 ? 0 : static_cast<double>(report.bytes) / static_cast<double>(report.primitives);
}

/// `chunk_fill` as words.
std::string fact_name(const LayoutFact& fact) {
  std::string name = fact.name;
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::string fact_figure(const LayoutFact& fact) {
  if (fact.per > 0) return significant(fact.figure());
  const auto value = static_cast<std::uint64_t>(fact.value);
  return fact.name.ends_with("_bytes") ? bytes_text(value) : grouped(value);
}

Json facts_json(const BuildReport& report) {
  Json out = Json::object();
  for (const LayoutFact& fact : report.facts) out[fact.name] = fact.figure();
  return out;
}

std::string structure_table(const BuildReport& report) {
  Table table({{"structure", Align::left}, {""}});
  table.add({"build time", duration_text(report.build_ms / 1000)});
  table.add({"triangles in it", grouped(report.primitives)});
  table.add({"triangles left out", grouped(report.left_out)});
  table.add({"memory of the layout", bytes_text(report.bytes)});
  table.add({"bytes per triangle", significant(bytes_per_triangle(report))});
  for (const LayoutFact& fact : report.facts) table.add({fact_name(fact), fact_figure(fact)});
  return table.text();
}

std::string trees_text(std::vector<MeshTree> trees) {
  std::ranges::stable_sort(trees, std::ranges::greater{}, &MeshTree::triangles);
  std::string out;
  for (std::size_t i = 0; i < std::min(trees.size(), most_trees_shown); ++i) {
    if (trees.size() > 1) out += fmt::format("\nMesh {}: {}\n", trees[i].mesh, counted(trees[i].triangles, "triangle"));
    out += fmt::format("\n{}{}", tree_text(trees[i].statistics), tree_metrics_text(trees[i].metrics));
  }
  if (trees.size() > most_trees_shown) {
    out += fmt::format("\nSmaller meshes with a tree of their own: {}; --json shows them.\n",
                       grouped(trees.size() - most_trees_shown));
  }
  return out;
}

Json inspection_json(const Scene& scene, const Structure& structure, const std::vector<MeshTree>& trees) {
  const BuildReport& report = structure.report();
  Json list = Json::array();
  for (const MeshTree& tree : trees) {
    Json entry = {{"mesh", tree.mesh}, {"triangles", tree.triangles}, {"split_cost_sum", tree.split_cost_sum}};
    entry.update(to_json(tree.statistics));
    entry["metrics"] = to_json(tree.metrics);
    list.push_back(std::move(entry));
  }
  return {{"scene", scene.name},
          {"triangles", scene.placed_triangles()},
          {"unique_triangles", scene.unique_triangles()},
          {"instances", scene.instances.size()},
          {"recipe", structure.recipe().text()},
          {"build_ms", measured_once(report.build_ms)},
          {"bytes", report.bytes},
          {"bytes_per_triangle", bytes_per_triangle(report)},
          {"sah_cost", report.sah_cost},
          {"nodes", report.nodes},
          {"left_out", report.left_out},
          {"layout", facts_json(report)},
          {"trees", std::move(list)},
          {"notes", to_json(scene.notes)}};
}

int run_inspect(const InspectOptions& options) {
  const Recipe recipe = Recipe::parse(options.recipe);
  const Scene scene = load_scene(options.scene);
  check_interrupt();
  const ExpectedUse use = expected_view(scene, options.view, options.common.threads);
  const Structure structure = build(scene, recipe, {.threads = options.common.threads, .use = &use});
  std::vector<MeshTree> trees;
  if (!is_peer(recipe)) {
    trees =
        run_in_arena(options.common.threads, [&] { return inspect_trees(scene, recipe, use, options.epo_samples); });
  }
  if (options.common.json) {
    print_json(inspection_json(scene, structure, trees));
    return exit_done;
  }
  std::string out = fmt::format("{}: {}", scene.name, counted(scene.placed_triangles(), "triangle"));
  if (!scene.single_level()) {
    out += fmt::format(", {} stored, in {}", grouped(scene.unique_triangles()),
                       counted(scene.instances.size(), "instance"));
  }
  out += fmt::format("\n{}\n\n{}", recipe.text(), structure_table(structure.report()));
  out += is_peer(recipe) ? "\nA peer's tree cannot be seen.\n" : trees_text(std::move(trees));
  for (const std::string& note : scene_notes(scene)) out += fmt::format("\nNote: {}\n", note);
  print(out);
  return exit_done;
}

}  // namespace

void add_inspect(CommandSet& commands) {
  const auto options = std::make_shared<InspectOptions>();
  Command command = commands.add("inspect", "Show everything that is known about one tree",
                                 [options] { return run_inspect(*options); });
  add_scene(command, options->scene);
  add_recipe(command, options->recipe);
  add_view(command, options->view);
  command.integer("--epo-samples", options->epo_samples, 0, 100'000'000,
                  "Triangles that tell the end-point overlap; 0: all");
  add_common(command, options->common);
}

}  // namespace boxwood::cli
