// The principal axes against slow arithmetic straight from the definition.
#include "math/principal_axes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "build/inputs.h"
#include "build/pca/rotated_centroids.h"

namespace boxwood {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

std::vector<Box> point_boxes(std::size_t count, Vec3 stretch, Vec3 offset) {
  std::vector<Box> boxes = random_boxes(count, 0);
  for (Box& box : boxes) box.lower = box.upper = box.lower * stretch + offset;
  return boxes;
}

/// Two passes, first the mean: the textbook's covariance.
Matrix covariance(const std::vector<Box>& boxes) {
  const auto n = static_cast<double>(boxes.size());
  std::array<double, 3> mean{};
  const auto at = [](const Box& box, std::size_t i) { return static_cast<double>(box.lower[i]); };
  for (const Box& box : boxes) {
    for (std::size_t i = 0; i < 3; ++i) mean[i] += at(box, i) / n;
  }
  Matrix sum{};
  for (const Box& box : boxes) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) sum[i][j] += (at(box, i) - mean[i]) * (at(box, j) - mean[j]) / n;
    }
  }
  return sum;
}

PrincipalAxes axes_of_boxes(const std::vector<Box>& boxes) {
  Moments moments;
  for (const Box& box : boxes) {
    const Vec3 d = box.lower - boxes.front().lower;
    moments.add(d.x, d.y, d.z);
  }
  return principal_axes(moments);
}

double dot(const double (&a)[3], const double (&b)[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

void expect_eigenvectors(const PrincipalAxes& axes, const Matrix& matrix) {
  const double scale = std::abs(axes.spread[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(dot(axes.axis[i], axes.axis[j]), i == j ? 1 : 0, 1e-12);
    for (std::size_t row = 0; row < 3; ++row) {
      double image = 0;
      for (std::size_t column = 0; column < 3; ++column) image += matrix[row][column] * axes.axis[i][column];
      EXPECT_NEAR(image, axes.spread[i] * axes.axis[i][row], 1e-6 * scale);
    }
    EXPECT_GE(axes.spread[i], -1e-9 * scale);
  }
  EXPECT_LE(axes.spread[0], axes.spread[1]);
  EXPECT_LE(axes.spread[1], axes.spread[2]);
}

TEST(PrincipalAxes, AreTheEigenvectorsOfTheCovariance) {
  for (const std::size_t count : {2u, 3u, 10u, 1000u}) {
    const std::vector<Box> boxes = point_boxes(count, {1, 2, 0.5f}, {});
    expect_eigenvectors(axes_of_boxes(boxes), covariance(boxes));
  }
}

TEST(PrincipalAxes, OfASmallSetFarAway_AsExactAsNearBy) {
  // 2^20 off the origin the coordinates keep 4 bits after the point; squares about the origin would lose them all.
  const std::vector<Box> boxes = point_boxes(500, {64, 16, 4}, {1048576, -1048576, 1048576});
  expect_eigenvectors(axes_of_boxes(boxes), covariance(boxes));
}

TEST(PrincipalAxes, OfAPointWithAWeight_AreThoseOfThatManyPoints) {
  const std::vector<Box> boxes = point_boxes(20, {1, 2, 3}, {});
  Moments weighted, repeated;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Vec3 p = boxes[i].lower;
    weighted.add(p.x, p.y, p.z, static_cast<double>(1 + i % 3));
    for (std::size_t n = 0; n <= i % 3; ++n) repeated.add(p.x, p.y, p.z);
  }
  const PrincipalAxes a = principal_axes(weighted), b = principal_axes(repeated);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a.spread[i], b.spread[i], 1e-12);
}

TEST(PrincipalAxes, OfCoincidentAndCoplanarPoints_StillOrthonormal) {
  for (const Vec3 stretch : {Vec3{0, 0, 0}, Vec3{1, 0, 1}, Vec3{0, 1, 0}}) {
    const PrincipalAxes axes = axes_of_boxes(point_boxes(50, stretch, {5, 5, 5}));
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(dot(axes.axis[i], axes.axis[j]), i == j ? 1 : 0, 1e-12);
    }
  }
}

ReferenceSet set_of(BuildInput& input) { return {input.references, {}, {}}; }

TEST(RotatedCentroids, OfPointsOnALine_DifferOnTheLastAxisOnly) {
  std::vector<Box> boxes;
  for (int i = 0; i < 20; ++i) {
    const Vec3 point = Vec3{1, 1, 1} * static_cast<float>(i * i);
    boxes.push_back({point, point});
  }
  BuildInput input = input_of(boxes);
  const Centroids centroids(input, CentroidKind::box);
  const Box4 range = RotatedCentroids(set_of(input), centroids).range(input.references);
  EXPECT_NEAR(range.upper[0] - range.lower[0], 0, 1e-3);
  EXPECT_NEAR(range.upper[1] - range.lower[1], 0, 1e-3);
  EXPECT_NEAR(range.upper[2] - range.lower[2], 2 * 361 * std::sqrt(3.0), 1e-2);
}

TEST(RotatedCentroids, KeepDistances) {
  BuildInput input = input_of(random_boxes(100));
  const Centroids centroids(input, CentroidKind::box);
  const RotatedCentroids rotated(set_of(input), centroids);
  const auto length = [](Float4 d) { return std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]); };
  for (std::size_t i = 1; i < input.references.size(); ++i) {
    const Reference &a = input.references[i - 1], &b = input.references[i];
    EXPECT_NEAR(length(rotated(a) - rotated(b)), length(centroids(a) - centroids(b)), 1e-5);
  }
}

}  // namespace
}  // namespace boxwood
