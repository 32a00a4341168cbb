// From the file to the study: every key, checked.
#include "study/study_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <set>

#include "boxwood/ray_set.h"
#include "measure/probe.h"
#include "options/suggest.h"
#include "study/expression.h"
#include "study/published.h"
#include "study/recipe_matrix.h"
#include "study/toml.h"

namespace boxwood {
namespace {

constexpr std::uint32_t most_pixels = 16384;

/// Runs `check` and lets what it throws point to the file.
template <class Check>
auto at(const TomlValue& where, const Check& check) {
  try {
    return check();
  } catch (const UsageError& error) {
    where.fail(fmt::format("is wrong: {}", error.what()));
  }
}

std::string one_of(TomlReader& reader, std::string_view key, std::string otherwise,
                   const std::vector<std::string>& valid) {
  const TomlValue* value = reader.find(key);
  if (!value) return otherwise;
  if (std::ranges::find(valid, value->text()) == valid.end()) {
    value->fail(fmt::format("knows no '{}'; {}", value->text(), suggest(value->text(), valid)));
  }
  return value->text();
}

void check_words(TomlReader& reader, std::string_view key, const std::vector<std::string>& words,
                 const std::vector<std::string>& valid) {
  for (const std::string& word : words) {
    if (std::ranges::find(valid, word) == valid.end()) {
      reader.need(key).fail(fmt::format("knows no '{}'; {}", word, suggest(word, valid)));
    }
  }
}

void read_run(const TomlValue& table, RunSpec& run, const std::vector<std::string>& scene_names) {
  TomlReader reader(table);
  run.rays = reader.words("rays", run.rays);
  check_words(reader, "rays", run.rays, {ray_kinds().begin(), ray_kinds().end()});
  if (const TomlValue* size = reader.find("size")) {
    if (!size->is_list() || size->list().size() != 2) size->fail("takes [width, height]");
    run.width = size->list()[0].integer(1, most_pixels);
    run.height = size->list()[1].integer(1, most_pixels);
  }
  run.bounces = reader.integer("bounces", 1, 16, run.bounces);
  run.ao_radius = static_cast<float>(reader.number("ao_radius", 0, 1e12, static_cast<double>(run.ao_radius)));
  if (const TomlValue* paths = reader.find("whole_paths")) {
    TomlReader path(*paths);
    run.whole_paths.emplace();
    run.whole_paths->ao_rays = path.integer("ao_rays", 1, 1024, run.whole_paths->ao_rays);
    path.done();
  }
  run.repetitions = reader.integer("repetitions", 1, 10000, run.repetitions);
  run.builds = reader.integer("builds", 1, 10000, run.builds);
  run.threads = reader.integer("threads", 1, 1024, run.threads);
  run.seed = reader.integer("seed", 0, 0xffffffff, static_cast<std::uint32_t>(run.seed));
  run.frames = reader.integer("frames", 0, 100000, run.frames);
  run.scenes = reader.words("scenes", run.scenes);
  check_words(reader, "scenes", run.scenes, scene_names);
  run.probes = reader.words("probes", run.probes);
  std::vector<std::string> probe_names;
  for (const Probe& probe : probes()) probe_names.push_back(probe.name);
  check_words(reader, "probes", run.probes, probe_names);
  run.centre = one_of(reader, "centre", run.centre, {"median", "mean"});
  reader.done();
}

/// Names each bounce, where there are several.
void name_bounces(RunSpec& run) {
  const auto found = std::ranges::find(run.rays, "diffuse");
  if (run.bounces == 1 || found == run.rays.end()) return;
  auto at = run.rays.erase(found);
  for (std::uint32_t bounce = run.bounces; bounce > 0; --bounce) {
    at = run.rays.insert(at, fmt::format("diffuse{}", bounce));
  }
}

/// What queries may name.
class Vocabulary {
 public:
  explicit Vocabulary(const std::vector<RecipeSpec>& recipes) {
    for (const char* known : {"scene", "view", "rays", "recipe"}) factors_.insert(known);
    for (const RecipeSpec& recipe : recipes) {
      for (const auto& [factor, level] : recipe.factors) {
        factors_.insert(factor);
        levels_[factor].insert(level);
      }
      levels_["recipe"].insert(recipe.label);
    }
    for (const std::string_view kind : ray_kinds()) levels_["rays"].emplace(kind);
  }

  bool knows_factor(const std::string& factor) const { return factors_.contains(factor); }
  void add_scene(const SceneSpec& scene) {
    levels_["scene"].insert(scene.name);
    for (const auto& [factor, level] : scene.set) {
      factors_.insert(factor);
      levels_[factor].insert(level);
    }
  }
  void add_rays(const RunSpec& run) { levels_["rays"].insert(run.rays.begin(), run.rays.end()); }

  void check_factor(const TomlValue& where, const std::string& factor) const {
    if (factors_.contains(factor)) return;
    const std::vector<std::string> names(factors_.begin(), factors_.end());
    where.fail(fmt::format("knows no factor '{}'; {}", factor, suggest(factor, names)));
  }

  /// Views are known only once the scene is.
  void check_level(const TomlValue& where, const std::string& factor, const std::string& level) const {
    const auto found = levels_.find(factor);
    if (found == levels_.end() || found->second.contains(level)) return;
    const std::vector<std::string> names(found->second.begin(), found->second.end());
    where.fail(fmt::format("knows no {} '{}'; {}", factor, level, suggest(level, names)));
  }

 private:
  std::set<std::string> factors_;
  std::map<std::string, std::set<std::string>> levels_;
};

Where read_where(TomlReader& reader, std::string_view key, const Vocabulary& vocabulary) {
  Where where;
  const TomlValue* table = reader.find(key);
  if (!table) return where;
  for (const auto& [factor, levels] : table->table()) {
    vocabulary.check_factor(levels, factor);
    where[factor] = levels.words();
    for (const std::string& level : where[factor]) vocabulary.check_level(levels, factor, level);
  }
  return where;
}

/// A list of [x, y, z].
std::vector<Vec3> read_points(const TomlValue& list) {
  std::vector<Vec3> points;
  for (const TomlValue& point : list.list()) {
    if (!point.is_list() || point.list().size() != 3) point.fail("takes [x, y, z], in shares of the scene's box");
    const auto share = [&](std::size_t axis) { return static_cast<float>(point.list()[axis].number(-100, 100)); };
    points.push_back({share(0), share(1), share(2)});
  }
  return points;
}

PathSpec read_path(const TomlValue& table) {
  TomlReader reader(table);
  PathSpec path;
  path.frames = reader.integer("frames", 1, 100000, path.frames);
  path.eyes = read_points(reader.need("eyes"));
  path.targets = read_points(reader.need("targets"));
  path.fov = static_cast<float>(reader.number("fov", 1, 179, static_cast<double>(path.fov)));
  reader.done();
  if (path.eyes.empty() || path.eyes.size() != path.targets.size()) {
    table.fail("needs as many targets as eyes, at least one of each");
  }
  return path;
}

SceneSpec read_scene(const TomlValue& table, const Vocabulary& vocabulary) {
  TomlReader reader(table);
  SceneSpec scene;
  scene.name = reader.need("name").text();
  scene.find = reader.need("find").words();
  scene.cameras = reader.words("cameras");
  if (const TomlValue* orbit = reader.find("orbit")) {
    TomlReader path(*orbit);
    scene.orbit.emplace();
    scene.orbit->frames = path.integer("frames", 1, 100000, scene.orbit->frames);
    scene.orbit->radius = path.number("radius", 0, 1e12, 0);
    scene.orbit->diagonals = path.number("diagonals", 0, 1e6, 0);
    scene.orbit->height = path.number("height", -1e12, 1e12, 0);
    if (const TomlValue* fov = path.find("fov")) scene.orbit->fov = fov->number(1, 179);
    path.done();
    if (!scene.cameras.empty()) orbit->fail("stands in place of 'cameras'; leave one of them out");
  }
  if (const TomlValue* path = reader.find("path")) {
    scene.path = read_path(*path);
    if (scene.orbit || !scene.cameras.empty()) path->fail("stands in place of 'cameras' and 'orbit'; leave those out");
  }
  if (const TomlValue* lights = reader.find("lights")) scene.lights = read_points(*lights);
  scene.rebuild = reader.integer("rebuild", 0, 100000, 0);
  if (const TomlValue* set = reader.find("set")) {
    for (const auto& [factor, level] : set->table()) scene.set[factor] = level.word();
  }
  scene.only = read_where(reader, "only", vocabulary);
  reader.done();
  return scene;
}

std::vector<std::string> read_factors(TomlReader& reader, std::string_view key, const Vocabulary& vocabulary) {
  const TomlValue* list = reader.find(key);
  if (!list) return {};
  std::vector<std::string> factors = list->words();
  for (const std::string& factor : factors) vocabulary.check_factor(*list, factor);
  return factors;
}

FigureSpec read_figure(TomlReader& reader, const Vocabulary& vocabulary) {
  FigureSpec figure;
  const TomlValue& value = reader.need("value");
  figure.value = value.text();
  const Expression parsed = at(value, [&] { return Expression::parse(figure.value); });
  figure.where = read_where(reader, "where", vocabulary);
  figure.baseline = read_where(reader, "baseline", vocabulary);
  if (parsed.names_baseline() && figure.baseline.empty())
    value.fail("names metrics of a baseline, so it needs 'baseline'");
  figure.each_view = one_of(reader, "views", "mean", {"mean", "each"}) == "each";
  return figure;
}

/// A figure that is a mean over views cannot be told apart by view.
void check_views(const TomlValue& where, const FigureSpec& figure,
                 std::initializer_list<std::vector<std::string>> factor_lists) {
  if (figure.each_view) return;
  bool named = figure.where.contains("view") || figure.baseline.contains("view");
  for (const std::vector<std::string>& factors : factor_lists) {
    named = named || std::ranges::find(factors, "view") != factors.end();
  }
  if (named) where.fail(R"(names views, so it needs views = "each")");
}

TableSpec read_table(const TomlValue& value, const Vocabulary& vocabulary) {
  TomlReader reader(value);
  TableSpec table;
  table.id = reader.need("id").text();
  table.title = reader.text("title", table.id);
  table.figure = read_figure(reader, vocabulary);
  table.rows = read_factors(reader, "rows", vocabulary);
  table.columns = read_factors(reader, "columns", vocabulary);
  table.spread = read_factors(reader, "spread", vocabulary);
  if (!table.spread.empty() && !table.columns.empty()) value.fail("has either columns or a spread, not both");
  check_views(value, table.figure, {table.rows, table.columns, table.spread});
  if (const TomlValue* published = reader.find("published")) table.published = read_published(*published);
  reader.done();
  return table;
}

/// A factor, or of scatter plots arithmetic on metrics.
void read_x(const TomlValue& x, const Vocabulary& vocabulary, PlotSpec& plot) {
  plot.x = x.text();
  plot.x_is_figure = plot.kind == "scatter" && !vocabulary.knows_factor(plot.x);
  if (plot.x_is_figure) {
    at(x, [&] { return Expression::parse(plot.x); });
  } else {
    vocabulary.check_factor(x, plot.x);
  }
}

void read_front(const TomlValue& value, PlotSpec& plot) {
  const std::vector<std::string> ends = value.words();
  const auto is_end = [](const std::string& word) { return word == "low" || word == "high"; };
  if (ends.size() != 2 || !std::ranges::all_of(ends, is_end)) {
    value.fail(R"(takes the better ends of x and y, such as ["low", "high"])");
  }
  if (!plot.x_is_figure) value.fail("needs a scatter plot whose x is arithmetic on metrics");
  const auto end = [&](std::size_t i) { return ends[i] == "low" ? PlotSpec::Better::low : PlotSpec::Better::high; };
  plot.front = {end(0), end(1)};
}

PlotSpec read_plot(const TomlValue& value, const Vocabulary& vocabulary) {
  TomlReader reader(value);
  PlotSpec plot;
  plot.id = reader.need("id").text();
  plot.title = reader.text("title", plot.id);
  plot.kind = one_of(reader, "kind", plot.kind, {"line", "bar", "scatter"});
  plot.figure = read_figure(reader, vocabulary);
  read_x(reader.need("x"), vocabulary, plot);
  plot.series = read_factors(reader, "series", vocabulary);
  plot.panels = read_factors(reader, "panels", vocabulary);
  check_views(value, plot.figure, {plot.series, plot.panels, {plot.x}});
  plot.x_title = reader.text("x_title", plot.x);
  plot.y_title = reader.text("y_title", plot.figure.value);
  plot.log_x = reader.boolean("log_x", false);
  plot.log_y = reader.boolean("log_y", false);
  if (const TomlValue* front = reader.find("front")) read_front(*front, plot);
  reader.done();
  return plot;
}

/// Exactly one of the keys that say what is expected.
std::optional<Expectation> read_expectation(TomlReader& reader, const Vocabulary& vocabulary) {
  using Kind = Expectation::Kind;
  std::optional<Expectation> found;
  const auto set = [&](const TomlValue& value, Expectation expectation) {
    if (found) value.fail("is a second expectation; a claim has one");
    found = std::move(expectation);
  };
  if (const TomlValue* v = reader.find("above")) set(*v, {Kind::above, v->number(), 0, {}});
  if (const TomlValue* v = reader.find("below")) set(*v, {Kind::below, 0, v->number(), {}});
  if (const TomlValue* v = reader.find("between")) {
    if (!v->is_list() || v->list().size() != 2) v->fail("takes [low, high]");
    set(*v, {Kind::between, v->list()[0].number(), v->list()[1].number(), {}});
  }
  if (const TomlValue* v = reader.find("differs_from")) set(*v, {Kind::differs, v->number(), v->number(), {}});
  if (const TomlValue* v = reader.find("same")) {
    if (!v->boolean()) v->fail("takes true only");
    set(*v, {Kind::same, 0, 0, {}});
  }
  if (const TomlValue* v = reader.find("splits_at")) {
    if (!v->is_list() || v->list().size() != 2) v->fail("takes [limit of the figure, limit of 'versus']");
    set(*v, {Kind::splits, v->list()[0].number(), v->list()[1].number(), {}});
  }
  for (const auto& [key, kind] : {std::pair{"rises_with", Kind::rises}, std::pair{"falls_with", Kind::falls},
                                  std::pair{"unrelated_to", Kind::unrelated}}) {
    const TomlValue* v = reader.find(key);
    if (!v) continue;
    const bool known = v->text() == "triangles" || v->text() == "baseline" || v->text() == "versus";
    if (!known) vocabulary.check_factor(*v, v->text());
    set(*v, {kind, 0, 0, v->text()});
  }
  return found;
}

void check_need(const TomlValue& value, const std::string& need) {
  if (need == "all" || need == "any" || need == "most" || need == "mean") return;
  if (value.is_text()) value.fail(R"(takes "all", "any", "most", "mean", or a share of the cells such as 0.75)");
  value.number(0, 1);
}

/// The second figure, which some expectations need and equality cannot use.
void read_versus(TomlReader& reader, const TomlValue& claim_value, const Vocabulary& vocabulary, ClaimSpec& claim) {
  using Kind = Expectation::Kind;
  const TomlValue* value = reader.find("versus");
  const bool needed = claim.expect->kind == Kind::splits || claim.expect->along == "versus";
  if (!value) {
    if (needed) claim_value.fail("compares two figures, so it needs 'versus'");
    return;
  }
  if (claim.expect->kind == Kind::same) value->fail("says nothing about whether figures are the same");
  const bool trend = !claim.expect->along.empty();
  if (trend && !needed) value->fail("is used by no expectation; write rises_with = \"versus\" or the like");
  TomlReader figure(*value);
  claim.versus = read_figure(figure, vocabulary);
  figure.done();
}

ClaimSpec read_claim(const TomlValue& value, const Vocabulary& vocabulary) {
  TomlReader reader(value);
  ClaimSpec claim;
  claim.id = reader.need("id").text();
  claim.text = reader.need("text").text();
  claim.published = reader.text("published");
  claim.note = reader.text("note");
  claim.expect = read_expectation(reader, vocabulary);
  if (claim.expect) {
    claim.figure = read_figure(reader, vocabulary);
    claim.each = read_factors(reader, "each", vocabulary);
    check_views(value, claim.figure, {claim.each});
    read_versus(reader, value, vocabulary, claim);
    if (const TomlValue* need = reader.find("need")) {
      claim.need = need->word();
      check_need(*need, claim.need);
    }
  } else if (claim.note.empty()) {
    value.fail(
        "needs an expectation (above, below, between, differs_from, same, rises_with, falls_with, unrelated_to, "
        "splits_at), or a "
        "note that says why it is not measured");
  }
  reader.done();
  return claim;
}

template <class Spec>
void check_distinct(const TomlValue& root, const std::vector<Spec>& specs, std::string Spec::*name,
                    std::string_view what) {
  std::set<std::string> seen;
  for (const Spec& spec : specs) {
    if (!seen.insert(spec.*name).second) root.fail(fmt::format("has two {} called '{}'", what, spec.*name));
  }
}

std::string stem(const std::string& file_name) { return std::filesystem::path(file_name).stem().string(); }

}  // namespace

Study parse_study(std::string_view text, const std::string& file_name, bool quick) {
  const std::unique_ptr<const TomlFile> file = parse_toml(text, file_name);
  TomlReader reader(file->root);
  Study study;
  study.file_text = text;
  study.quick = quick;
  study.name = reader.text("name", stem(file_name));
  study.title = reader.text("title", study.name);
  study.source = reader.text("source");
  study.text = reader.text("text");
  const TomlValue* shared = reader.find("values");
  for (const TomlValue* recipes : reader.tables("recipes")) {
    for (RecipeSpec& recipe : recipe_matrix(*recipes, shared)) study.recipes.push_back(std::move(recipe));
  }
  Vocabulary vocabulary(study.recipes);
  for (const TomlValue* scene : reader.tables("scene")) {
    study.scenes.push_back(read_scene(*scene, vocabulary));
    vocabulary.add_scene(study.scenes.back());
  }
  if (study.scenes.empty()) file->root.fail("needs at least one [[scene]]");
  if (study.recipes.empty()) file->root.fail("needs at least one [[recipes]]");
  std::vector<std::string> scene_names;
  for (const SceneSpec& scene : study.scenes) scene_names.push_back(scene.name);
  if (const TomlValue* run = reader.find("run")) read_run(*run, study.run, scene_names);
  if (const TomlValue* run = reader.find("quick")) {
    RunSpec checked = study.run;
    read_run(*run, quick ? study.run : checked, scene_names);
  }
  name_bounces(study.run);
  vocabulary.add_rays(study.run);
  for (const TomlValue* table : reader.tables("table")) study.tables.push_back(read_table(*table, vocabulary));
  for (const TomlValue* plot : reader.tables("plot")) study.plots.push_back(read_plot(*plot, vocabulary));
  for (const TomlValue* claim : reader.tables("claim")) study.claims.push_back(read_claim(*claim, vocabulary));
  study.pictures = reader.words("pictures");
  std::vector<std::string> labels;
  for (const RecipeSpec& recipe : study.recipes) labels.push_back(recipe.label);
  check_words(reader, "pictures", study.pictures, labels);
  reader.done();
  check_distinct(file->root, study.scenes, &SceneSpec::name, "scenes");
  check_distinct(file->root, study.recipes, &RecipeSpec::label, "recipes");
  check_distinct(file->root, study.tables, &TableSpec::id, "tables");
  check_distinct(file->root, study.plots, &PlotSpec::id, "plots");
  check_distinct(file->root, study.claims, &ClaimSpec::id, "claims");
  return study;
}

Study read_study(const std::filesystem::path& file, bool quick) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error(fmt::format("the study {} cannot be read", file.string()));
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return parse_study(text, file.string(), quick);
}

}  // namespace boxwood
