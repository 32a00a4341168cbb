// Every generator, one line each, and how one is called by text.
#include "scene/generators.h"

#include <fmt/format.h>

#include "options/call.h"
#include "options/suggest.h"
#include "scene/generators/generator.h"

namespace boxwood {
namespace {

const Generator& find_generator(std::string_view name) {
  std::vector<std::string> names;
  for (const Generator& generator : generators()) {
    if (generator.name == name) return generator;
    names.push_back(generator.name);
  }
  throw UsageError(fmt::format("no generator is called '{}'; {}", name, suggest(name, names)));
}

}  // namespace

const std::vector<Generator>& generators() {
  static const std::vector<Generator> all = {
      sphere_generator(),      cube_generator(),       torus_generator(),     knot_generator(),
      sphereflake_generator(), terrain_generator(),    hair_generator(),      lawn_generator(),
      city_generator(),        stadium_generator(),    instances_generator(), random_generator(),
      displaced_generator(),   tetrahedra_generator(), single_generator(),    none_generator(),
      coincident_generator(),  coplanar_generator(),   nested_generator(),    zero_area_generator(),
      non_finite_generator(),  huge_generator(),
  };
  return all;
}

void check_size(std::uint64_t triangles) {
  constexpr std::uint64_t most = 200'000'000;
  if (triangles > most) {
    throw UsageError(
        fmt::format("these options ask for {} triangles, more than {}; use smaller ones", triangles, most));
  }
}

Scene generate(std::string_view text) {
  const CallText call = parse_call_text(text);
  const Generator& generator = find_generator(call.name);
  std::any options = generator.defaults;
  set_options(generator.options, options, call);
  Scene scene = generator.make(options);
  scene.name = trim(text);
  return scene;
}

}  // namespace boxwood
