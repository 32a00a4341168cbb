// Bins, borders, divisions and slabs are those of plain loops, on every instruction set.
#include "build/bin_kernels.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <numeric>

#include "build/spatial/split.h"
#include "fastbuild/trees.h"
#include "simd/test_targets.h"

namespace boxwood {
namespace {

/// References of any number, all with something in their fourth lanes.
LargeVector<Reference> references_of(const Triangles& triangles) {
  LargeVector<Reference> out = triangles.input().references;
  for (Reference& reference : out) reference.seen = reference.primitive % 2 != 0 ? 1.0f : 0.0f;
  return out;
}

Box4 centers_of(std::span<const Reference> references) {
  Box4 out;
  for (const Reference& reference : references) out.grow(box4(reference).lower + box4(reference).upper);
  return out;
}

struct Filled {
  std::array<GrownBox, 4 * max_bins_in_rows> boxes;
  std::array<std::uint32_t, 4 * max_bins_in_rows> counts;
  BinRows rows;

  Filled(std::span<const Reference> references, const Slabs& slabs, std::uint32_t bins)
      : rows{boxes.data(), counts.data(), bins} {
    fill_bins(references, slabs.scale(), rows);
  }
};

class BinKernels : public testing::TestWithParam<std::int64_t> {
 protected:
  BinKernels() : only_(GetParam()) {}

  /// Calls check(references, slabs, bins) for sets of several sizes.
  template <class Check>
  static void for_each_set(const Check& check) {
    for (const std::size_t count : {1u, 2u, 7u, 63u, 64u, 501u}) {
      const LargeVector<Reference> references = references_of(Triangles("scattered", scattered(count, 0.2f)));
      for (const std::uint32_t bins : {2u, 5u, 8u, 64u}) {
        check(references, Slabs(centers_of(references), bins), bins);
      }
    }
  }

 private:
  OnlyTarget only_;
};

TEST_P(BinKernels, FilledBins_HoldWhatFallsIntoThem) {
  for_each_set([](const LargeVector<Reference>& references, const Slabs& slabs, std::uint32_t bins) {
    const Filled filled(references, slabs, bins);
    for (std::uint32_t b = 0; b < bins; ++b) {
      for (int axis = 0; axis < 3; ++axis) {
        Box box;
        std::uint32_t count = 0;
        for (const Reference& reference : references) {
          if (slabs(reference.center2(axis), axis) != static_cast<std::int32_t>(b)) continue;
          box.grow(reference.box());
          ++count;
        }
        EXPECT_EQ(filled.counts[4 * b + static_cast<std::size_t>(axis)], count);
        EXPECT_EQ(filled.boxes[4 * b + static_cast<std::size_t>(axis)].box().box(), box);
      }
    }
  });
}

TEST_P(BinKernels, CheapestBorder_IsTheFirstOfTheCheapest) {
  for_each_set([](const LargeVector<Reference>& references, const Slabs& slabs, std::uint32_t bins) {
    for (const std::uint32_t shift : {0u, 2u}) {
      const BinBorder found = cheapest_border(Filled(references, slabs, bins).rows, shift);
      BinBorder best;
      for (std::int32_t axis = 0; axis < 3; ++axis) {
        for (std::int32_t border = 1; border < static_cast<std::int32_t>(bins); ++border) {
          Box4 left, right;
          std::uint32_t left_count = 0, right_count = 0;
          for (const Reference& reference : references) {
            const bool is_left = slabs(reference.center2(axis), axis) < border;
            (is_left ? left : right).grow(box4(reference));
            ++(is_left ? left_count : right_count);
          }
          if (left_count == 0 || right_count == 0) continue;
          const LeafPrice price{shift};
          const float cost = half_area(left) * price(left_count) + half_area(right) * price(right_count);
          if (cost < best.cost) best = {cost, axis, border, left, right, left_count, right_count};
        }
      }
      EXPECT_EQ(found.cost, best.cost);
      if (best.border == 0) continue;
      EXPECT_EQ(std::tie(found.axis, found.border, found.left_count, found.right_count),
                std::tie(best.axis, best.border, best.left_count, best.right_count));
      EXPECT_EQ(found.left.box(), best.left.box());
      EXPECT_EQ(found.right.box(), best.right.box());
    }
  });
}

TEST_P(BinKernels, Division_KeepsAllAndKnowsTheirCentres) {
  for_each_set([](LargeVector<Reference> references, const Slabs& slabs, std::uint32_t bins) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto border = static_cast<std::int32_t>(bins / 2);
      Box4 front, back;
      const std::size_t count = divide_at(references, slabs.scale(), axis, border, front, back);
      std::vector<bool> there(references.size());
      for (std::size_t i = 0; i < references.size(); ++i) {
        EXPECT_EQ(slabs(references[i].center2(axis), axis) < border, i < count);
        EXPECT_EQ(references[i].seen, references[i].primitive % 2 != 0 ? 1.0f : 0.0f);
        there[references[i].primitive] = true;
      }
      EXPECT_EQ(std::count(there.begin(), there.end(), true), static_cast<std::ptrdiff_t>(references.size()));
      const std::span<const Reference> all(references);
      EXPECT_EQ(front.box(), centers_of(all.first(count)).box());
      EXPECT_EQ(back.box(), centers_of(all.subspan(count)).box());
    }
  });
}

/// What a slab's part of a triangle must at least be, and about what it may be.
TEST_P(BinKernels, PartsInSlabs_AreThoseOfClipping) {
  const Triangles triangles("needles", needles(60));
  const LargeVector<Reference> references = references_of(triangles);
  for (const Reference& reference : references) {
    Box4 bounds = box4(reference);
    for (const std::uint32_t bins : {2u, 8u, 13u}) {
      for (int axis = 0; axis < 3; ++axis) {
        const SlabAxis slabs = Slabs(bounds, bins).along(axis, bins);
        SlabContents contents;
        fill_slabs({&reference, 1}, triangles, slabs, contents);
        EXPECT_EQ(std::accumulate(contents.begin.begin(), contents.begin.begin() + bins, 0u), 1u);
        EXPECT_EQ(std::accumulate(contents.end.begin(), contents.end.begin() + bins, 0u), 1u);
        for (std::uint32_t s = 0; s < bins; ++s) {
          Box region = reference.box();
          region.lower[static_cast<std::size_t>(axis)] = slabs.borders[s];
          region.upper[static_cast<std::size_t>(axis)] = slabs.borders[s + 1];
          const Box exact = triangles.clip(reference.primitive, region), found = contents.boxes[s].box();
          for (std::size_t a = 0; a < 3 && !exact.empty(); ++a) {
            EXPECT_NEAR(found.lower[a], exact.lower[a], 1e-5f);
            EXPECT_NEAR(found.upper[a], exact.upper[a], 1e-5f);
          }
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, BinKernels, testing::ValuesIn(testable_targets()),
                         [](const auto& test) { return std::string(hwy::TargetName(test.param)); });

}  // namespace
}  // namespace boxwood
