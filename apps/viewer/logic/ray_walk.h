#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/ray.h"
#include "boxwood/scene.h"
#include "layout/trace_options.h"
#include "tree/tree.h"

namespace boxwood::viewer {

/// One thing that a walking ray does.
struct WalkStep {
  enum class Kind { missed, entered, skipped, tested, hit };
  Kind kind;
  std::uint32_t node = 0;  ///< of the tree
  std::uint32_t depth = 0;
  bool leaf = false;
  float t = 0;                  ///< where the box is entered, or the triangle hit
  std::uint32_t primitive = 0;  ///< of a triangle test
};

/// A ray's way through a tree, step by step, and what it cost.
struct RayWalk {
  std::vector<WalkStep> steps;
  std::uint32_t node_tests = 0, node_hits = 0, leaves = 0, primitive_tests = 0;
  Hit hit;
};

/// Walks `ray` through the tree over `mesh` as a layout would, nearest or first child first: boxes missed, boxes
/// entered, what is skipped because a hit lies before it, triangles tested. The same hit as any structure's, whose
/// planes or quantised boxes may cost other tests.
RayWalk walk_ray(const Tree& tree, const Mesh& mesh, const Ray& ray, ChildOrder order);

/// One line for a person to read.
std::string describe(const WalkStep& step);

}  // namespace boxwood::viewer
