#include "soak/soak.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <filesystem>
#include <optional>

#include "boxwood/ray_set.h"
#include "boxwood/saved.h"
#include "boxwood/structure.h"
#include "measure/clock.h"
#include "soak/random_recipe.h"
#include "soak/random_scene.h"
#include "trace/brute_force.h"

namespace boxwood {
namespace {

constexpr std::size_t most_failures = 20;

std::string describe(const Hit& hit) {
  if (!hit.valid()) return "a miss";
  return fmt::format("triangle {} of instance {} at t = {:a}, u = {:a}, v = {:a}", hit.primitive, hit.instance, hit.t,
                     hit.u, hit.v);
}

std::string describe(const Ray& ray) {
  return fmt::format("origin ({:a}, {:a}, {:a}), direction ({:a}, {:a}, {:a}), t {:a} to {:a}", ray.origin.x,
                     ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z, ray.t_near,
                     ray.t_far);
}

// Also tells -0 from 0, which the answers must agree on.
// NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
bool same_bits(const Hit& a, const Hit& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

struct Truth {
  std::vector<Hit> hits;
  std::vector<std::uint8_t> blocked;

  Truth(const Scene& scene, std::span<const Ray> rays) : hits(rays.size()), blocked(rays.size()) {
    const BruteForce brute_force(scene);
    brute_force.closest_hits(rays, hits);
    brute_force.any_hits(rays, blocked);
  }
};

std::string compare_answers(const Structure& structure, std::span<const Ray> rays, const Truth& truth) {
  std::vector<Hit> batch(rays.size()), counted(rays.size());
  std::vector<std::uint8_t> blocked(rays.size()), blocked_counted(rays.size());
  std::vector<RayCounters> counters(rays.size());
  structure.closest_hits(rays, batch);
  structure.any_hits(rays, blocked);
  structure.closest_hits_counted(rays, counted, counters);
  structure.any_hits_counted(rays, blocked_counted, counters);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto differs = [&](const char* how, const Hit& hit) {
      return fmt::format("{} gives {} where every triangle gives {}; {}", how, describe(hit), describe(truth.hits[i]),
                         describe(rays[i]));
    };
    const Hit single = structure.closest_hit(rays[i]);
    if (!same_bits(batch[i], truth.hits[i])) return differs("a batch", batch[i]);
    if (!same_bits(single, truth.hits[i])) return differs("one ray", single);
    if (!same_bits(counted[i], truth.hits[i])) return differs("a counted ray", counted[i]);
    const bool expected = truth.blocked[i] != 0;
    if ((blocked[i] != 0) != expected || (blocked_counted[i] != 0) != expected ||
        structure.any_hit(rays[i]) != expected) {
      return fmt::format("any hit says {} (batch), {} (counted), {} (one ray) where every triangle says {}; {}",
                         blocked[i], blocked_counted[i], structure.any_hit(rays[i]), expected, describe(rays[i]));
    }
  }
  return {};
}

/// A file that goes when the check is over.
class ScratchFile {
 public:
  ScratchFile() {
    static std::atomic<unsigned> serial{0};
    path_ = std::filesystem::temp_directory_path() / fmt::format("boxwood-soak-{}-{}", getpid(), serial++);
  }
  ~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A use made of the rays themselves, for recipes that ask.
ExpectedUse use_of(const Scene& scene, std::span<const Ray> rays) {
  const std::vector<RaySet> sets = {{"primary", Query::closest_hit, {rays.begin(), rays.end()}},
                                    {"shadow", Query::any_hit, {rays.begin(), rays.end()}}};
  ExpectedUse use = expect_use(build(scene, "median > binary", {.threads = 1}), sets, sets);
  Camera camera;
  if (const Box box = scene.bounds(); !box.empty()) camera.eye = box.upper;
  camera.direction = {-1, -1, -1};
  use.views = {{camera, 16, 16}};
  return use;
}

}  // namespace

std::string find_difference(const Structure& structure, const Scene& scene, std::span<const Ray> rays) {
  return compare_answers(structure, rays, Truth(scene, rays));
}

std::string find_disagreement(const Scene& scene, const Recipe& recipe, std::span<const Ray> rays,
                              std::string& refused) {
  const Truth truth(scene, rays);
  ExpectedUse use;
  if (needs_use(recipe)) use = use_of(scene, rays);
  std::optional<Structure> structure;
  try {
    structure = build(scene, recipe, {.threads = 2, .use = &use});
  } catch (const Error& error) {
    refused = error.what();
    return {};
  }
  if (std::string what = compare_answers(*structure, rays, truth); !what.empty()) return what;
  if (!can_save(*structure)) return {};
  const ScratchFile file;
  save(*structure, file.path());
  const std::string what = compare_answers(load_structure(file.path()), rays, truth);
  return what.empty() ? what : "after saving and loading, " + what;
}

SoakResult soak(const SoakSettings& settings, ProgressSink* progress) {
  SoakResult result;
  const double begin = now(Clock::wall);
  while (settings.cases == 0 || result.cases < settings.cases) {
    const double spent = now(Clock::wall) - begin;
    if (spent >= settings.seconds || result.failures.size() >= most_failures) break;
    report_progress(progress, spent / settings.seconds, fmt::format("case {}", settings.first + result.cases));
    const std::uint64_t number = settings.first + result.cases++;
    Random random(settings.seed, number);
    const Scene scene = random_scene(random);
    const Recipe recipe = random_recipe(random);
    const std::vector<Ray> rays = random_rays_at(scene, settings.rays, random);
    result.rays += rays.size();
    std::string refused, what;
    try {
      what = find_disagreement(scene, recipe, rays, refused);
    } catch (const std::exception& error) {
      what = fmt::format("it ended with: {}", error.what());
    }
    if (!refused.empty()) ++result.refusals[refused];
    if (!what.empty()) result.failures.push_back({number, scene.name, recipe.text(), what});
  }
  return result;
}

}  // namespace boxwood
