#pragma once
#include <cstdint>
#include <string>
#include <utility>

#include "scene/generators.h"

namespace boxwood {

/// One registry line from a function on a typed options struct.
template <class Options>
Generator scene_generator(std::string name, std::string summary, OptionsOf<Options> description,
                          Scene (*make)(const Options&)) {
  return {std::move(name), std::move(summary), Options{}, description.take(),
          [make](const std::any& options) { return make(std::any_cast<const Options&>(options)); }};
}

/// The same for a scene that is one mesh.
template <class Options>
Generator mesh_generator(std::string name, std::string summary, OptionsOf<Options> description,
                         Mesh (*make)(const Options&)) {
  return {std::move(name), std::move(summary), Options{}, description.take(), [make](const std::any& options) {
            Scene scene;
            scene.meshes.push_back(make(std::any_cast<const Options&>(options)));
            scene.instances.push_back({0, {}});
            return scene;
          }};
}

/// Options combine to more than memory can hold: throws UsageError above 200 million triangles.
void check_size(std::uint64_t triangles);

// Triangle soups: soups.cpp
Generator random_generator();
Generator displaced_generator();
Generator tetrahedra_generator();
// Closed meshes: closed.cpp
Generator sphere_generator();
Generator cube_generator();
Generator torus_generator();
Generator knot_generator();
// Things that look like something: sphereflake.cpp, landscape.cpp, built.cpp
Generator sphereflake_generator();
Generator hair_generator();
Generator terrain_generator();
Generator lawn_generator();
Generator city_generator();
Generator stadium_generator();
Generator instances_generator();
// What breaks builders: degenerate.cpp
Generator single_generator();
Generator none_generator();
Generator coincident_generator();
Generator coplanar_generator();
Generator nested_generator();
Generator zero_area_generator();
Generator non_finite_generator();
Generator huge_generator();

}  // namespace boxwood
