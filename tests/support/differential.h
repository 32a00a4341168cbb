#pragma once
// Whatever can be traced against brute force.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/counters.h"
#include "trace/brute_force.h"

namespace boxwood::test {

/// Rays with what brute force says of them.
struct Expected {
  std::vector<Ray> rays;
  std::vector<Hit> hits;

  Expected(const Scene& scene, std::vector<Ray> asked) : rays(std::move(asked)), hits(rays.size()) {
    BruteForce(scene).closest_hits(rays, hits);
  }
};

inline bool same_bits(const Hit& a, const Hit& b) {
  const auto bits = [](float f) { return std::bit_cast<std::uint32_t>(f); };
  return bits(a.t) == bits(b.t) && bits(a.u) == bits(b.u) && bits(a.v) == bits(b.v) && a.primitive == b.primitive &&
         a.instance == b.instance;
}

inline std::string describe(const Ray& ray, const Hit& expected, const Hit& found) {
  char text[400];
  std::snprintf(text, sizeof text,
                "origin %.9g %.9g %.9g direction %.9g %.9g %.9g in [%.9g, %.9g]: expected t %.9g primitive %u of %u, "
                "found t %.9g primitive %u of %u",
                ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z, ray.t_near,
                ray.t_far, expected.t, expected.primitive, expected.instance, found.t, found.primitive, found.instance);
  return text;
}

/// Every query of a Layout or a Structure: batch, single, counted; closest and any.
template <class Traceable>
void expect_brute_force_answers(const Traceable& traceable, const Expected& expected, const std::string& what) {
  const std::size_t count = expected.rays.size();
  std::vector<Hit> batch(count), counted(count);
  std::vector<std::uint8_t> blocked(count), blocked_counted(count);
  std::vector<RayCounters> counters(count);
  traceable.closest_hits(expected.rays, batch);
  traceable.any_hits(expected.rays, blocked);
  traceable.closest_hits_counted(expected.rays, counted, counters);
  traceable.any_hits_counted(expected.rays, blocked_counted, counters);
  std::size_t failures = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Ray& ray = expected.rays[i];
    const Hit& hit = expected.hits[i];
    const Hit single = traceable.closest_hit(ray);
    const bool right = same_bits(batch[i], hit) && same_bits(counted[i], hit) && same_bits(single, hit) &&
                       (blocked[i] != 0) == hit.valid() && (blocked_counted[i] != 0) == hit.valid() &&
                       traceable.any_hit(ray) == hit.valid();
    if (right || ++failures > 3) continue;
    ADD_FAILURE() << what << ", ray " << i << ": " << describe(ray, hit, batch[i]) << "; counted primitive "
                  << counted[i].primitive << ", single " << single.primitive << ", any " << int{blocked[i]};
  }
  EXPECT_EQ(failures, 0u) << what;
}

}  // namespace boxwood::test
