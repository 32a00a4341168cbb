#include "motion_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "measure/clock.h"
#include "measure/interleave.h"
#include "measure/trace_rays.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

struct Way {
  MotionRow row;
  MovingStructure moving;
  double rebuilt_triangles = 0;
};

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<Way> make_ways(const Scene& scene, const MotionSettings& settings) {
  std::vector<Way> ways;
  const auto add = [&](const char* name, const std::string& recipe, Rebuild rebuild) {
    const Recipe parsed = Recipe::parse(recipe);
    MotionRow row;
    row.way = name;
    row.recipe = parsed.text();
    ways.push_back({std::move(row),
                    MovingStructure(scene, parsed, {rebuild, settings.rays_per_frame, settings.build_price},
                                    {.threads = settings.threads}),
                    0});
  };
  add("refit", settings.recipe, Rebuild::never);
  add("parts", settings.recipe, Rebuild::worst_parts);
  add("policy", settings.recipe, Rebuild::when_it_pays);
  add("rebuild", settings.recipe, Rebuild::all);
  add("fast", "fast", Rebuild::all);
  return ways;
}

class FrameRun {
 public:
  FrameRun(std::vector<Way>& ways, const MotionSettings& settings)
      : ways_(ways), settings_(settings), clock_(settings.threads == 1 ? Clock::thread_cpu : Clock::wall) {}

  void update(const std::vector<std::vector<Vec3>>& positions, std::string& reason) {
    for (Way& way : ways_) {
      for (std::uint32_t m = 0; m < positions.size(); ++m) way.moving.move_vertices(m, positions[m]);
      const double begin = now(clock_);
      const UpdateReport report = way.moving.update();
      way.row.frame_update_ms.push_back((now(clock_) - begin) * 1000);
      way.rebuilt_triangles += static_cast<double>(report.rebuilt_triangles);
      if (reason.empty()) reason = report.reason;
      way.row.frame_sah_cost.push_back(way.moving.structure().report().sah_cost);
    }
  }

  /// Traces what the frame's camera sees, in every structure in turn.
  std::uint64_t trace() {
    std::vector<Structure> structures;
    for (const Way& way : ways_) structures.push_back(way.moving.structure());
    std::vector<double> seconds(ways_.size());
    std::uint64_t rays = 0;
    run_in_arena(settings_.threads, [&] {
      const Scene& scene = ways_.front().moving.scene();
      for (const RaySet& set : make_ray_sets(scene, structures.front(), settings_.rays, settings_.kinds)) {
        rays += set.rays.size();
        time_set(structures, set, seconds);
      }
    });
    for (std::size_t w = 0; w < ways_.size(); ++w) {
      ways_[w].row.frame_mrays_per_s.push_back(static_cast<double>(rays) / seconds[w] * 1e-6);
    }
    return rays;
  }

 private:
  void time_set(const std::vector<Structure>& structures, const RaySet& set, std::vector<double>& seconds) {
    std::vector<Answers> answers(structures.size(), Answers(set));
    std::vector<Contestant> contestants;
    for (std::size_t w = 0; w < structures.size(); ++w) {
      contestants.emplace_back([&, w] {
        const double begin = now(clock_);
        trace_rays(structures[w], set, answers[w]);
        return now(clock_) - begin;
      });
    }
    const std::vector<std::vector<double>> times = interleave(contestants, {settings_.repeats, 1});
    for (std::size_t w = 0; w < structures.size(); ++w) {
      seconds[w] += median(times[w]);
      ways_[w].row.mismatches += mismatches(answers.front(), answers[w], true);
    }
  }

  std::vector<Way>& ways_;
  const MotionSettings& settings_;
  Clock clock_;
};

/// update + n * time per ray is the lesser from this n on.
double break_even(const MotionRow& refit, const MotionRow& other) {
  const double saved_ns = refit.mean_ns_per_ray - other.mean_ns_per_ray;
  const double spent_ns = (other.mean_update_ms - refit.mean_update_ms) * 1e6;
  if (saved_ns <= 0) return std::numeric_limits<double>::infinity();
  return std::max(0.0, spent_ns / saved_ns);
}

void finish(std::vector<Way>& ways, const Scene& scene, const MotionSettings& settings) {
  const std::vector<double>& anew = ways[3].row.frame_sah_cost;
  for (Way& way : ways) {
    MotionRow& row = way.row;
    const std::size_t frames = row.frame_update_ms.size();
    row.update_ms = estimate_median(row.frame_update_ms);
    row.mrays_per_s = estimate_median(row.frame_mrays_per_s);
    row.mean_update_ms = mean_of(row.frame_update_ms);
    std::vector<double> ratios, ns_per_ray;
    for (std::size_t f = 0; f < frames; ++f) {
      ratios.push_back(anew[f] > 0 ? row.frame_sah_cost[f] / anew[f] : 1);
      ns_per_ray.push_back(1000 / row.frame_mrays_per_s[f]);
    }
    row.mean_sah_ratio = mean_of(ratios);
    row.last_sah_ratio = ratios.back();
    row.mean_ns_per_ray = mean_of(ns_per_ray);
    row.frame_ms = row.mean_update_ms + settings.rays_per_frame * row.mean_ns_per_ray * 1e-6;
    row.rebuilt_share =
        way.rebuilt_triangles / static_cast<double>(frames) / static_cast<double>(scene.unique_triangles());
    row.pays_from_rays = break_even(ways.front().row, row);
  }
}

}  // namespace

MotionComparison compare_motion(const MotionFrames& frames, const MotionSettings& settings, ProgressSink* progress) {
  MotionComparison out;
  std::vector<Way> ways = make_ways(frames.rest(), settings);
  FrameRun run(ways, settings);
  for (std::uint32_t f = 1; f <= frames.count(); ++f) {
    run.update(frames.positions(f), out.reason);
    out.rays = run.trace();
    report_progress(progress, static_cast<double>(f) / static_cast<double>(frames.count()), "following the frames");
  }
  finish(ways, frames.rest(), settings);
  for (Way& way : ways) out.rows.push_back(std::move(way.row));
  return out;
}

}  // namespace boxwood::cli
