#include "advise/trial.h"

#include <algorithm>
#include <optional>

#include "boxwood/structure.h"
#include "measure/clock.h"
#include "measure/trace_rays.h"

namespace boxwood {
namespace {

constexpr std::size_t largest_batch = 8;

struct Contender {
  std::size_t trial;
  Structure structure;
  std::vector<double> seconds;
};

/// Answers to all ray sets, kept so that no pass allocates.
class Course {
 public:
  Course(std::span<const RaySet> ray_sets, Clock clock) : ray_sets_(ray_sets), clock_(clock) {
    for (const RaySet& set : ray_sets) answers_.emplace_back(set);
  }
  double run(const Structure& structure) {
    const double begin = now(clock_);
    for (std::size_t i = 0; i < ray_sets_.size(); ++i) trace_rays(structure, ray_sets_[i], answers_[i]);
    return std::max(now(clock_) - begin, 1e-9);  // a clock that has not moved would make an infinite speed
  }

 private:
  std::span<const RaySet> ray_sets_;
  Clock clock_;
  std::vector<Answers> answers_;
};

std::optional<Structure> try_to_build(const Scene& scene, const TrialSettings& settings, Trial& trial) {
  try {
    Structure structure = build(scene, trial.recipe, {.threads = settings.threads, .use = settings.use});
    trial.build_ms = structure.report().build_ms;
    trial.bytes = structure.report().bytes;
    return structure;
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    trial.refused = error.what();
    return {};
  }
}

void time_batch(std::vector<Contender>& batch, const Structure& reference, Course& course, std::uint32_t repeats,
                std::vector<Trial>& trials) {
  std::vector<double> reference_seconds;
  for (std::uint32_t pass = 0; pass <= repeats; ++pass) {  // the first warms up
    const double own = course.run(reference);
    if (pass > 0) reference_seconds.push_back(own);
    for (Contender& contender : batch) {
      const double seconds = course.run(contender.structure);
      if (pass > 0) contender.seconds.push_back(seconds);
    }
  }
  for (const Contender& contender : batch) {
    Trial& trial = trials[contender.trial];
    trial.ratio = estimate_ratio(reference_seconds, contender.seconds);
    trial.measured = true;
  }
  batch.clear();
}

bool dominates(const Trial& a, const Trial& b) {
  const bool nowhere_worse = a.ratio.median >= b.ratio.median && a.build_ms <= b.build_ms && a.bytes <= b.bytes;
  const bool somewhere_better = a.ratio.median > b.ratio.median || a.build_ms < b.build_ms || a.bytes < b.bytes;
  return nowhere_worse && somewhere_better;
}

std::vector<Trial> by_speed(std::span<const Trial> trials) {
  std::vector<Trial> out;
  std::ranges::copy_if(trials, std::back_inserter(out), &Trial::measured);
  std::ranges::stable_sort(out, std::ranges::greater{}, [](const Trial& trial) { return trial.ratio.median; });
  return out;
}

}  // namespace

std::vector<Trial> run_trials(const Scene& scene, std::span<const Recipe> recipes, const Structure& reference,
                              std::span<const RaySet> ray_sets, const TrialSettings& settings, ProgressSink* progress) {
  std::vector<Trial> trials;
  for (const Recipe& recipe : recipes) trials.push_back({recipe, false, {}, 0, 0, {}});
  Course course(ray_sets, settings.threads == 1 ? Clock::thread_cpu : Clock::wall);
  std::vector<Contender> batch;
  std::size_t batch_bytes = 0;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    report_progress(progress, static_cast<double>(i) / static_cast<double>(trials.size()), "trying recipes");
    if (i >= largest_batch && settings.deadline > 0 && now(Clock::wall) > settings.deadline) break;
    if (std::optional<Structure> structure = try_to_build(scene, settings, trials[i])) {
      batch_bytes += trials[i].bytes;
      batch.push_back({i, std::move(*structure), {}});
    }
    if (batch.size() < largest_batch && batch_bytes < settings.batch_bytes) continue;
    time_batch(batch, reference, course, settings.repeats, trials);
    batch_bytes = 0;
  }
  if (!batch.empty()) time_batch(batch, reference, course, settings.repeats, trials);
  return trials;
}

std::vector<Trial> pareto_front(std::span<const Trial> trials) {
  std::vector<Trial> front;
  for (const Trial& trial : by_speed(trials)) {
    const bool beaten =
        std::ranges::any_of(trials, [&](const Trial& other) { return other.measured && dominates(other, trial); });
    if (!beaten) front.push_back(trial);
  }
  return front;
}

std::vector<Trial> survivors(std::span<const Trial> trials, std::size_t count, const Limits& limits) {
  std::vector<Trial> allowed;
  std::ranges::copy_if(trials, std::back_inserter(allowed), [&](const Trial& trial) {
    return trial.measured && (limits.build_ms == 0 || trial.build_ms <= limits.build_ms) &&
           (limits.bytes == 0 || static_cast<double>(trial.bytes) <= limits.bytes);
  });
  std::vector<Trial> out = by_speed(allowed);
  if (out.size() <= count) return out;
  out.resize(count - count / 3, out.front());
  const auto taken = [&](const Trial& trial) {
    return std::ranges::any_of(out, [&](const Trial& other) { return other.recipe == trial.recipe; });
  };
  for (const Trial& trial : pareto_front(allowed)) {
    if (out.size() < count && !taken(trial)) out.push_back(trial);
  }
  for (const Trial& trial : by_speed(allowed)) {
    if (out.size() < count && !taken(trial)) out.push_back(trial);
  }
  return by_speed(out);
}

}  // namespace boxwood
