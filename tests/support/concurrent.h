#pragma once
#include <cstdint>
#include <thread>
#include <vector>

#include "boxwood/structure.h"

namespace boxwood::test {

/// Whether any of several threads that ask at once gets another answer than one that asks alone.
inline bool answers_differ(const Structure& structure, const std::vector<Ray>& rays) {
  std::vector<Hit> expected(rays.size());
  std::vector<std::uint8_t> expected_blocked(rays.size());
  structure.closest_hits(rays, expected);
  structure.any_hits(rays, expected_blocked);
  std::vector<std::uint8_t> wrong(6, 0);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    threads.emplace_back([&, t] {
      std::vector<Hit> hits(rays.size());
      std::vector<std::uint8_t> blocked(rays.size());
      for (int round = 0; round < 5; ++round) {
        structure.closest_hits(rays, hits);
        structure.any_hits(rays, blocked);
        if (hits != expected || blocked != expected_blocked) wrong[t] = 1;
        for (std::size_t i = t; i < rays.size(); i += wrong.size()) {
          if (structure.closest_hit(rays[i]) != expected[i]) wrong[t] = 1;
          if (structure.any_hit(rays[i]) != (expected_blocked[i] != 0)) wrong[t] = 1;
          const std::vector<Hit> all = structure.all_hits(rays[i]);
          if (all.empty() ? expected[i].valid() : all.front() != expected[i]) wrong[t] = 1;
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  return wrong != std::vector<std::uint8_t>(wrong.size(), 0);
}

}  // namespace boxwood::test
