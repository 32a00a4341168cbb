// `boxwood verify`: is every answer the one that testing every triangle gives, and are closed meshes closed to rays?
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "aimed_rays.h"
#include "boxwood/ray_set.h"
#include "command.h"
#include "console.h"
#include "every_recipe.h"
#include "exit_code.h"
#include "expected_view.h"
#include "recipe/capabilities.h"
#include "report/json.h"
#include "report/number_text.h"
#include "report/progress_bar.h"
#include "report/table.h"
#include "trace/brute_force.h"
#include "trace/precise_brute_force.h"
#include "trace/widened.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

struct VerifyOptions {
  CommonOptions common;
  ViewOptions view;
  std::string scene;
  std::vector<std::string> recipes;  ///< empty: every registered builder and layout, walked in every way
  std::uint32_t rays = 10000;        ///< at most; brute force on a large mesh gets fewer
  std::string load_rays;
};

constexpr double most_triangle_tests = 1.5e9;  // by brute force; some ten seconds on two cores
constexpr std::uint64_t seed = 1;

/// Rays of one kind and all their true hits, in order.
struct Question {
  std::string kind;
  std::vector<Ray> rays;
  std::vector<std::vector<Hit>> hits;

  Hit closest(std::size_t ray) const { return hits[ray].empty() ? Hit{} : hits[ray].front(); }
};

struct RecipeVerdict {
  std::string recipe;
  std::uint64_t mismatches = 0, leaks = 0;
  std::string example;  ///< the first mismatch or leak, as a sentence
};

/// At most `most` rays, evenly picked.
std::vector<Ray> sampled(const std::vector<Ray>& rays, std::size_t most) {
  if (rays.size() <= most) return rays;
  std::vector<Ray> out;
  for (std::size_t i = 0; i < most; ++i) out.push_back(rays[i * rays.size() / most]);
  return out;
}

std::vector<Question> make_questions(const Scene& scene, const VerifyOptions& options) {
  std::vector<RaySet> sets;
  if (!options.load_rays.empty()) sets = load_ray_sets(options.load_rays);
  RaySetSettings settings;
  settings.camera = find_camera(scene, options.view);
  settings.width = options.view.width;
  settings.height = options.view.height;
  settings.random_rays = options.rays;
  settings.seed = seed;
  const std::vector<std::string> kinds = {"primary", "random", "axis", "grazing"};
  const Structure structure = build(scene, "default", {.threads = options.common.threads});
  for (RaySet& set : make_ray_sets(scene, structure, settings, kinds)) sets.push_back(std::move(set));
  sets.push_back({"aimed at edges and vertices", Query::closest_hit, rays_at_edges(scene, options.rays, seed)});

  const auto triangles = static_cast<double>(std::max<std::uint64_t>(1, scene.placed_triangles()));
  const double affordable = std::max(1.0, std::min<double>(options.rays, most_triangle_tests / triangles));
  const auto share = static_cast<std::size_t>(std::ceil(affordable / static_cast<double>(sets.size())));
  std::vector<Question> questions;
  questions.reserve(sets.size());
  for (const RaySet& set : sets) questions.push_back({set.kind, sampled(set.rays, share), {}});
  return questions;
}

void answer_by_brute_force(const Scene& scene, std::vector<Question>& questions, ProgressSink& progress) {
  constexpr std::size_t chunk = 64;  // rays between two looks at Ctrl-C
  const BruteForce truth(scene);
  std::size_t total = 0, done = 0;
  for (const Question& question : questions) total += question.rays.size();
  for (Question& question : questions) {
    question.hits.resize(question.rays.size());
    for (std::size_t begin = 0; begin < question.rays.size(); begin += chunk) {
      const std::size_t count = std::min(chunk, question.rays.size() - begin);
      tbb::parallel_for(begin, begin + count,
                        [&](std::size_t i) { question.hits[i] = truth.all_hits(question.rays[i]); });
      done += count;
      report_progress(&progress, static_cast<double>(done) / static_cast<double>(total), "testing every triangle");
    }
  }
}

/// What testing every triangle in double precision says, rounded as structures round it.
std::vector<Question> answered_in_double(const Scene& scene, std::vector<Question> questions) {
  std::vector<DoubleVec3> vertices;
  for (const Vec3& position : scene.meshes[0].positions) vertices.push_back(widened(position));
  const PreciseBruteForce truth(vertices, scene.meshes[0].triangles);
  for (Question& question : questions) {
    tbb::parallel_for(std::size_t{0}, question.rays.size(), [&](std::size_t i) {
      const Hit hit = rounded(truth.closest_hit(widened(question.rays[i])));
      question.hits[i].assign(hit.valid() ? 1 : 0, hit);
    });
  }
  return questions;
}

/// Peers compute t in their own way.
bool same(const Hit& a, const Hit& b, bool exact) {
  if (exact) return a == b;
  return a.valid() == b.valid() && (!a.valid() || std::fabs(a.t - b.t) <= 1e-4f * std::fabs(b.t));
}

std::string hit_text(const Hit& hit) {
  if (!hit.valid()) return "nothing";
  return fmt::format("triangle {} of instance {} at t = {}", hit.primitive, hit.instance, hit.t);
}

std::string ray_text(const Ray& ray) {
  return fmt::format("the ray from ({}, {}, {}) along ({}, {}, {})", ray.origin.x, ray.origin.y, ray.origin.z,
                     ray.direction.x, ray.direction.y, ray.direction.z);
}

/// Batch and single-ray queries, closest and any hit, and, of our own layouts, all hits; each ray with a wrong answer
/// counts once.
void check_answers(const Structure& structure, const Question& question, RecipeVerdict& verdict) {
  const bool exact = !is_peer(structure.recipe()), all = answers_exactly(structure.recipe().stages());
  std::vector<Hit> hits(question.rays.size());
  std::vector<std::uint8_t> blocked(question.rays.size());
  structure.closest_hits(question.rays, hits);
  structure.any_hits(question.rays, blocked);
  for (std::size_t i = 0; i < question.rays.size(); ++i) {
    const Ray& ray = question.rays[i];
    const Hit truth = question.closest(i);
    const bool all_right = !all || structure.all_hits(ray) == question.hits[i];
    const bool right = all_right && same(hits[i], truth, exact) && same(structure.closest_hit(ray), truth, exact) &&
                       (blocked[i] != 0) == truth.valid() && structure.any_hit(ray) == truth.valid();
    if (right) continue;
    ++verdict.mismatches;
    if (!verdict.example.empty()) continue;
    verdict.example = fmt::format("{} ({}): {} hits {}, brute force {}; any hit says {}, all hits are {}",
                                  verdict.recipe, question.kind, ray_text(ray), hit_text(hits[i]), hit_text(truth),
                                  blocked[i] != 0 ? "blocked" : "free", all_right ? "right" : "wrong");
  }
}

void check_leaks(const Structure& structure, const std::vector<Ray>& rays, RecipeVerdict& verdict) {
  std::vector<Hit> hits(rays.size());
  std::vector<std::uint8_t> blocked(rays.size());
  structure.closest_hits(rays, hits);
  structure.any_hits(rays, blocked);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].valid() && blocked[i] != 0) continue;
    ++verdict.leaks;
    if (verdict.example.empty()) {
      verdict.example = fmt::format("{}: {} leaves a closed mesh", verdict.recipe, ray_text(rays[i]));
    }
  }
}

std::vector<RecipeVerdict> check_recipes(const Scene& scene, const std::vector<Recipe>& recipes,
                                         const std::vector<Question>& questions, const InsideRays& inside,
                                         const VerifyOptions& options, ProgressSink& progress) {
  std::vector<RecipeVerdict> verdicts;
  const std::optional<ExpectedUse> use = expected_view(scene, recipes, options.view, options.common.threads);
  for (const Recipe& recipe : recipes) {
    const Structure structure = build(scene, recipe, {.threads = options.common.threads, .use = pointer_to(use)});
    RecipeVerdict verdict;
    verdict.recipe = recipe.text();
    std::vector<Question> in_double;
    if (precision_of(recipe.stages()) == Precision::double_test) in_double = answered_in_double(scene, questions);
    for (const Question& question : in_double.empty() ? questions : in_double) {
      check_answers(structure, question, verdict);
    }
    check_leaks(structure, inside.rays, verdict);
    verdicts.push_back(std::move(verdict));
    report_progress(&progress, static_cast<double>(verdicts.size()) / static_cast<double>(recipes.size()), "checking");
  }
  return verdicts;
}

struct Totals {
  std::uint64_t rays = 0, mismatches = 0, leaks = 0;
};

/// `rays` counts each ray once, however many recipes answered it.
Totals totals_of(const std::vector<Question>& questions, const InsideRays& inside,
                 const std::vector<RecipeVerdict>& verdicts) {
  Totals totals;
  totals.rays = inside.rays.size();
  for (const Question& question : questions) totals.rays += question.rays.size();
  for (const RecipeVerdict& verdict : verdicts) {
    totals.mismatches += verdict.mismatches;
    totals.leaks += verdict.leaks;
  }
  return totals;
}

Json verification_json(const Scene& scene, const std::vector<Question>& questions, const InsideRays& inside,
                       const std::vector<RecipeVerdict>& verdicts) {
  const Totals totals = totals_of(questions, inside, verdicts);
  Json kinds = Json::object(), rows = Json::array();
  for (const Question& question : questions) kinds[question.kind] = question.rays.size();
  for (const RecipeVerdict& verdict : verdicts) {
    rows.push_back({{"recipe", verdict.recipe},
                    {"mismatches", verdict.mismatches},
                    {"leaks", verdict.leaks},
                    {"example", verdict.example}});
  }
  return {{"scene", scene.name},
          {"triangles", scene.placed_triangles()},
          {"rays", totals.rays},
          {"mismatches", totals.mismatches},
          {"leaks", totals.leaks},
          {"rays_by_kind", std::move(kinds)},
          {"closed_meshes", inside.closed_meshes},
          {"rays_from_inside", inside.rays.size()},
          {"rows", std::move(rows)}};
}

std::string verification_text(const Scene& scene, const std::vector<Question>& questions, const InsideRays& inside,
                              const std::vector<RecipeVerdict>& verdicts) {
  const Totals totals = totals_of(questions, inside, verdicts);
  std::string out = fmt::format("{}: {}\n\nRays answered by testing every triangle:\n", scene.name,
                                counted(scene.placed_triangles(), "triangle"));
  for (const Question& question : questions) {
    out += fmt::format("  {:>9}  {}\n", grouped(question.rays.size()), question.kind);
  }
  out += inside.rays.empty()
             ? fmt::format("Leaks are not tested: {}\n\n",
                           inside.closed_meshes == 0 ? "no mesh is closed" : "no point inside a mesh was found")
             : fmt::format(
                   "Rays that must not leave a closed mesh:\n  {:>9}  from inside, at edges and "
                   "vertices\n\n",
                   grouped(inside.rays.size()));
  Table table({{"recipe", Align::left}, {"mismatches"}, {"leaks"}});
  for (const RecipeVerdict& verdict : verdicts) {
    table.add({verdict.recipe, grouped(verdict.mismatches), inside.rays.empty() ? "–" : grouped(verdict.leaks)});
  }
  out += table.text();
  for (const RecipeVerdict& verdict : verdicts) {
    if (!verdict.example.empty()) out += fmt::format("\nFor example, {}\n", verdict.example);
  }
  const bool good = totals.mismatches == 0 && totals.leaks == 0;
  return out + fmt::format("\n{}\n", good ? "Every answer is right." : "THERE ARE WRONG ANSWERS.");
}

int run_verify(const VerifyOptions& options) {
  const std::vector<Recipe> recipes = options.recipes.empty() ? every_recipe() : parse_recipes(options.recipes);
  const Scene scene = load_scene(options.scene);
  for (const std::string& note : scene_notes(scene)) complain(note);
  check_interrupt();
  std::vector<Question> questions;
  InsideRays inside;
  std::vector<RecipeVerdict> verdicts;
  run_in_arena(options.common.threads, [&] {
    questions = make_questions(scene, options);
    inside = rays_from_inside(scene, options.rays, seed);
    ProgressBar truth_bar(stop_requested());
    answer_by_brute_force(scene, questions, truth_bar);
    ProgressBar recipes_bar(stop_requested());
    verdicts = check_recipes(scene, recipes, questions, inside, options, recipes_bar);
  });
  if (options.common.json) {
    print_json(verification_json(scene, questions, inside, verdicts));
  } else {
    print(verification_text(scene, questions, inside, verdicts));
  }
  const Totals totals = totals_of(questions, inside, verdicts);
  return totals.mismatches == 0 && totals.leaks == 0 ? exit_done : exit_failed;
}

}  // namespace

void add_verify(CommandSet& commands) {
  const auto options = std::make_shared<VerifyOptions>();
  Command command = commands.add("verify", "Check answers against brute force, and closed meshes for leaks",
                                 [options] { return run_verify(*options); });
  add_scene(command, options->scene);
  add_recipes(command, options->recipes, "What to check; say it once for each (none: everything there is)");
  command.integer("--rays", options->rays, 1, 100000000, "Rays at most; large meshes get fewer");
  command.text("--load-rays", options->load_rays, "FILE", "Also check the rays of a file");
  add_view(command, options->view);
  add_common(command, options->common);
}

}  // namespace boxwood::cli
