#pragma once
#include <fmt/format.h>

#include <cstddef>

#include "boxwood/error.h"

namespace boxwood {

inline void check_same_length(std::size_t rays, std::size_t answers) {
  if (rays != answers) throw UsageError(fmt::format("{} rays need as many answers, not {}", rays, answers));
}

/// For k answers each.
inline void check_answers_per_query(std::size_t queries, std::size_t k, std::size_t answers) {
  if (k == 0 ? answers == 0 : answers % k == 0 && answers / k == queries) return;
  throw UsageError(fmt::format("{} queries for {} answers each need {} times as many answers, not {} in all", queries,
                               k, k, answers));
}

}  // namespace boxwood
