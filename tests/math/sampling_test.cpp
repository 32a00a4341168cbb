#include "math/sampling.h"

#include <gtest/gtest.h>

#include <array>

#include "math/random.h"

namespace boxwood {
namespace {

TEST(SineCosine, OfTurnsAgreesWithTheLibraryAndIsExactAtQuarters) {
  for (int i = -3000; i <= 3000; ++i) {
    const double turns = i / 997.0;
    const SineCosine found = sine_cosine_of_turns(turns);
    ASSERT_NEAR(found.sine, std::sin(2 * std::numbers::pi * turns), 1e-13);
    ASSERT_NEAR(found.cosine, std::cos(2 * std::numbers::pi * turns), 1e-13);
  }
  EXPECT_EQ(sine_cosine_of_turns(0.25).cosine, 0);
  EXPECT_EQ(sine_cosine_of_turns(0.5).sine, 0);
}

TEST(Random, IsTheSameEverywhere) {
  static_assert(Random(1, 2).bits() == Random(1, 2).bits());
  static_assert(Random(1, 2).bits() != Random(1, 3).bits());
  static_assert(Random(1, 2).bits() != Random(2, 2).bits());
}

TEST(Random, BelowIsUniform) {
  Random random(7);
  std::array<int, 6> counts{};
  for (int i = 0; i < 60'000; ++i) ++counts[random.below(6)];
  for (const int count : counts) EXPECT_NEAR(count, 10'000, 500);
  EXPECT_EQ(random.below(1), 0u);
}

TEST(Random, StreamsAreUniformAndUnrelated) {
  double mean = 0, product = 0;
  constexpr int count = 20'000;
  for (std::uint64_t stream = 0; stream < count; ++stream) {
    const double a = static_cast<double>(Random(1, stream).uniform()) - 0.5;
    mean += a;
    product += a * (static_cast<double>(Random(1, stream + 1).uniform()) - 0.5);
  }
  EXPECT_NEAR(mean / count, 0, 0.01);
  EXPECT_NEAR(product / count, 0, 0.005);
}

/// Mean direction over a grid of samples.
template <class Map>
Vec3 mean_direction(const Map& map) {
  constexpr int side = 100;
  Vec3 sum;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const Vec3 direction = map((static_cast<float>(i) + 0.5f) / side, (static_cast<float>(j) + 0.5f) / side);
      EXPECT_NEAR(length(direction), 1, 1e-5);
      sum += direction;
    }
  }
  return sum / (side * side);
}

TEST(Sampling, MeanDirectionsAreThoseOfTheirDensities) {
  EXPECT_NEAR(length(mean_direction(uniform_sphere)), 0, 1e-4);
  EXPECT_NEAR(length(mean_direction(uniform_hemisphere) - Vec3{0, 0, 0.5f}), 0, 1e-4);
  EXPECT_NEAR(length(mean_direction(cosine_hemisphere) - Vec3{0, 0, 2.0f / 3}), 0, 1e-4);
}

TEST(Basis, IsRightHandedForEveryNormal) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const float u = random.uniform(), v = random.uniform();
    const Basis basis(i == 0 ? Vec3{0, 0, -1} : uniform_sphere(u, v));
    EXPECT_NEAR(length(cross(basis.x, basis.y) - basis.normal), 0, 1e-5);
    EXPECT_NEAR(dot(basis.x, basis.y), 0, 1e-5);
  }
}

TEST(UniformRotation, IsARotation) {
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    const float u = random.uniform(), v = random.uniform(), w = random.uniform();
    const Transform turn = uniform_rotation(u, v, w);
    EXPECT_NEAR(turn.determinant(), 1, 1e-5);
    EXPECT_NEAR(dot(turn.x, turn.y), 0, 1e-5);
    EXPECT_NEAR(length(turn.x), 1, 1e-5);
  }
}

}  // namespace
}  // namespace boxwood
