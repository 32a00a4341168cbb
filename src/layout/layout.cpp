#include "layout/layout.h"

#include <algorithm>

#include "boxwood/error.h"
#include "layout/saved_level.h"

namespace boxwood {

RayCounters& operator+=(RayCounters& sum, const RayCounters& more) {
  sum.steps += more.steps;
  sum.leaves += more.leaves;
  sum.node_tests += more.node_tests;
  sum.node_hits += more.node_hits;
  sum.primitive_tests += more.primitive_tests;
  return sum;
}

void Layout::closest_below(const Ray& ray, Descent descent, Hit& best, RayCounters* counters) const {
  Ray shortened = ray;
  shortened.t_far = std::min(ray.t_far, best.t);
  Hit hit;
  if (counters) {
    RayCounters spent;
    closest_hits_counted({&shortened, 1}, {&hit, 1}, {&spent, 1});
    *counters += spent;
  } else {
    hit = closest_hit(shortened);
  }
  if (!hit.valid()) return;
  hit.instance += descent.first_instance;
  const bool wins = hit.t != best.t                 ? hit.t < best.t
                    : hit.instance != best.instance ? hit.instance < best.instance
                                                    : hit.primitive < best.primitive;
  if (wins) best = hit;
}

bool Layout::any_below(const Ray& ray, std::uint32_t, RayCounters* counters) const {
  if (!counters) return any_hit(ray);
  RayCounters spent;
  std::uint8_t blocked = 0;
  any_hits_counted({&ray, 1}, {&blocked, 1}, {&spent, 1});
  *counters += spent;
  return blocked != 0;
}

void Layout::closest_hits_masked(std::span<const Ray> rays, std::span<const std::uint32_t>, std::span<Hit> hits) const {
  closest_hits(rays, hits);
}

void Layout::any_hits_masked(std::span<const Ray> rays, std::span<const std::uint32_t>,
                             std::span<std::uint8_t> blocked) const {
  any_hits(rays, blocked);
}

void add_facts(std::vector<LayoutFact>& sums, const std::vector<LayoutFact>& facts) {
  for (const LayoutFact& fact : facts) {
    const auto sum = std::ranges::find(sums, fact.name, &LayoutFact::name);
    if (sum == sums.end()) {
      sums.push_back(fact);
    } else {
      sum->value += fact.value;
      sum->per += fact.per;
    }
  }
}

std::optional<SavedLevel> Layout::saved() const { return {}; }

bool Layout::refit(const Tree&, const Mesh&) { return false; }

void Layout::offer_hits(const Ray&, Descent, HitSink&) const { refuse_to_offer(); }

void Layout::refuse_to_offer() {
  throw UsageError(
      "a peer finds closest and any hits only; all hits, the first k hits, filters and masks need a layout of our own, "
      "such as the preset 'default'");
}

}  // namespace boxwood
