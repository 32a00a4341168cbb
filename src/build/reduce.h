#pragma once
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

#include <span>

#include "build/top_down.h"

namespace boxwood {

/// Folds references into one value: fold(part, value) adds a part of them, join(a, b) puts two values together. Large
/// sets are shared out among threads, but always in the same way, so rounding and ties do not depend on their number.
/// Isolated, so that waiting does not start another subtree on top of this one's stack.
template <class Value, class Fold, class Join>
Value reduce(std::span<const Reference> references, const Value& nothing, const Fold& fold, const Join& join) {
  if (references.size() < parallel_size) return fold(references, nothing);
  return tbb::this_task_arena::isolate([&] {
    return tbb::parallel_deterministic_reduce(
        tbb::blocked_range<std::size_t>(0, references.size(), parallel_size / 4), nothing,
        [&](const tbb::blocked_range<std::size_t>& range, const Value& value) {
          return fold(references.subspan(range.begin(), range.size()), value);
        },
        join);
  });
}

}  // namespace boxwood
