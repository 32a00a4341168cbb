// A structure as a file: its recipe, its report, then facts, nodes and leaves of every level, the lower ones first.
#include "boxwood/saved.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "layout/layout.h"
#include "layout/saved_kind.h"
#include "layout/saved_level.h"
#include "recipe/stage.h"
#include "saved/section_file.h"
#include "structure/instance_paths.h"

namespace boxwood {
namespace {

struct SavedReport {
  double build_ms, sah_cost;
  std::uint64_t nodes, primitives, left_out;
  std::uint64_t levels;
};
static_assert(sizeof(SavedReport) == 48);

/// All levels, the one that answers queries last; none when one of them cannot be saved.
std::vector<SavedLevel> levels_of(const Structure& structure) {
  if (structure.paths() && !structure.paths()->first_numbers().empty()) return {};  // placed: of many recipes
  std::optional<SavedLevel> top = structure.layout()->saved();
  if (!top) return {};
  std::vector<SavedLevel> levels;
  for (const auto& bottom : top->bottoms) {
    std::optional<SavedLevel> level = bottom->saved();
    if (!level) return {};
    levels.push_back(std::move(*level));
  }
  levels.push_back(std::move(*top));
  return levels;
}

template <class T>
T read_object(SectionFile& file, SectionKind kind) {
  const auto bytes = file.next(kind);
  T object;
  if (bytes.size() != sizeof object) file.fail("a section has another size than it should");
  std::memcpy(static_cast<void*>(&object), bytes.data(), sizeof object);
  return object;
}

Recipe read_recipe(SectionFile& file) {
  const auto bytes = file.next(SectionKind::recipe);
  try {
    return Recipe::parse({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  } catch (const UsageError& error) {
    file.fail(fmt::format("its recipe is not one of this program ({})", error.what()));
  }
}

TraceOptions trace_of(const Recipe& recipe) {
  for (const StageCall& call : recipe.stages()) {
    if (call.stage->kind == StageKind::trace) return std::any_cast<const TraceOptions&>(call.options);
  }
  return {};
}

/// A level with the layout that it is.
struct ReadLevel {
  SavedFacts facts;
  Box bounds;
  std::shared_ptr<const Layout> layout;
};

ReadLevel read_level(SectionFile& file, const TraceOptions& trace, bool verify,
                     const std::vector<std::shared_ptr<const Layout>>& bottoms) {
  SavedLevel level;
  level.facts = read_object<SavedFacts>(file, SectionKind::facts);
  level.nodes = file.next(SectionKind::nodes);
  level.leaves = file.next(SectionKind::leaves);
  level.owner = file.owner();
  if (level.facts.instances) level.bottoms = bottoms;
  if (verify) {
    if (const std::string damage = find_damage(level, trace); !damage.empty()) file.fail(damage);
  }
  try {
    auto layout = layout_of(level, trace);
    return {level.facts, bounds_of(level), std::move(layout)};
  } catch (const Error& error) {
    file.fail(error.what());
  }
}

std::string name_of(const Scene& scene) { return scene.name.empty() ? "the scene" : scene.name; }

}  // namespace

bool can_save(const Structure& structure) { return !levels_of(structure).empty(); }

void save(const Structure& structure, const std::filesystem::path& file) {
  const std::vector<SavedLevel> levels = levels_of(structure);
  if (levels.empty()) {
    throw UsageError(
        fmt::format("a structure built by '{}' cannot be saved; files hold the layouts binary, wide(k) and "
                    "compressed(k), of scenes",
                    structure.recipe().text()));
  }
  const std::string recipe = structure.recipe().text();
  const BuildReport& built = structure.report();
  const SavedReport report{built.build_ms,   built.sah_cost, built.nodes,
                           built.primitives, built.left_out, levels.size()};
  std::vector<Section> sections = {{SectionKind::recipe, std::as_bytes(std::span(recipe))},
                                   {SectionKind::report, std::as_bytes(std::span(&report, 1))}};
  for (const SavedLevel& level : levels) {
    sections.push_back({SectionKind::facts, std::as_bytes(std::span(&level.facts, 1))});
    sections.push_back({SectionKind::nodes, level.nodes});
    sections.push_back({SectionKind::leaves, level.leaves});
  }
  write_sections(file, sections);
}

Structure load_structure(const std::filesystem::path& path, const LoadOptions& options) {
  const bool verify = options.verification == Verification::full;
  SectionFile file(path, verify);
  const Recipe recipe = read_recipe(file);
  const auto saved = read_object<SavedReport>(file, SectionKind::report);
  if (!std::isfinite(saved.build_ms) || !std::isfinite(saved.sah_cost) || saved.levels == 0) {
    file.fail("its report makes no sense");
  }
  BuildReport report{saved.build_ms, 0, saved.sah_cost, saved.nodes, saved.primitives, saved.left_out, {}, {}};
  std::vector<std::shared_ptr<const Layout>> levels;
  std::shared_ptr<const InstancePaths> paths;
  for (std::uint64_t i = 0; i < saved.levels; ++i) {
    ReadLevel level = read_level(file, trace_of(recipe), verify, levels);
    if (paths) file.fail("it has a level above one of instances");
    if (level.facts.instances) paths = std::make_shared<const InstancePaths>(level.facts.primitives);
    report.bounds = level.bounds;
    levels.push_back(std::move(level.layout));
    report.bytes += levels.back()->bytes();
    add_facts(report.facts, levels.back()->facts());
  }
  if (!file.at_end()) file.fail("it has more sections than levels");
  return {levels.back(), std::move(report), recipe, std::move(paths)};
}

void check_fits(const Structure& structure, const Scene& scene) {
  const std::optional<SavedLevel> top = structure.layout()->saved();
  if (!top) return;
  const auto check = [&](bool fits, const char* what, std::uint64_t expected, std::uint64_t has) {
    if (fits) return;
    throw Error(fmt::format("the structure was built from {} {}, but {} has {}; build it anew from this scene",
                            expected, what, name_of(scene), has));
  };
  const auto check_mesh = [&](const SavedLevel& level, std::uint32_t mesh) {
    const std::uint64_t has = scene.meshes[mesh].triangles.size();
    check(level.facts.primitives <= has, "or more triangles in a mesh", level.facts.primitives, has);
  };
  const std::uint64_t triangles = structure.report().primitives + structure.report().left_out;
  check(triangles == scene.unique_triangles(), "triangles", triangles, scene.unique_triangles());
  if (!top->facts.instances) {
    check(scene.instances.size() == 1, "instance", 1, scene.instances.size());
    return check_mesh(*top, scene.instances.front().mesh);
  }
  check(top->facts.primitives <= scene.instances.size(), "or more instances", top->facts.primitives,
        scene.instances.size());
  // Opened instances place several structures of one mesh each.
  std::vector<std::optional<SavedLevel>> bottoms;
  for (const auto& bottom : top->bottoms) bottoms.push_back(bottom->saved());
  for (const SavedInstance& placed : elements_of<SavedInstance>(top->leaves, "instances")) {
    if (bottoms[placed.bottom]) check_mesh(*bottoms[placed.bottom], scene.instances[placed.instance].mesh);
  }
}

}  // namespace boxwood
