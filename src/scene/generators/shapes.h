#pragma once
#include <cstdint>

#include "boxwood/scene.h"
#include "math/random.h"

namespace boxwood {

// Closed meshes around the origin: every edge belongs to exactly two triangles, which run along it in opposite
// directions; seen from outside, vertices run counter-clockwise.

/// The cube [-1, 1]^3 with detail x detail squares on each side; 12 detail^2 triangles.
Mesh cube_mesh(std::uint32_t detail);
/// The unit sphere, a cube blown up; 12 detail^2 triangles.
Mesh sphere_mesh(std::uint32_t detail);
/// Ring of radius 1 around the y axis, tube of radius 0.35; 4 detail^2 triangles, detail >= 3.
Mesh torus_mesh(std::uint32_t detail);
/// Trefoil knot of radius about 1; 16 detail^2 triangles, detail >= 3.
Mesh knot_mesh(std::uint32_t detail);

/// Uniform in the cube [low, high]^3.
Vec3 uniform_point(Random& random, float low, float high);
/// Appends a copy of `mesh`, scaled and moved.
void append(Mesh& to, const Mesh& mesh, float scale, const Vec3& move);
/// Appends one triangle with vertices of its own.
void append_triangle(Mesh& to, const Vec3& a, const Vec3& b, const Vec3& c);
/// Appends the closed box, 12 triangles, 8 vertices.
void append_box(Mesh& to, const Box& box);

}  // namespace boxwood
