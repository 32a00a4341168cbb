// Closed meshes, also what watertightness is tested on.
#include "scene/generators/generator.h"
#include "scene/generators/shapes.h"

namespace boxwood {
namespace {

template <std::uint32_t default_detail>
struct Detail {
  std::uint32_t detail = default_detail;
};

template <std::uint32_t default_detail>
Generator shape(std::string name, std::string summary, std::uint32_t least, std::string help,
                Mesh (*make)(const Detail<default_detail>&)) {
  using Options = Detail<default_detail>;
  return mesh_generator(
      std::move(name), std::move(summary),
      OptionsOf<Options>().integer("detail", &Options::detail, least, 4096, std::move(help)).positional(), make);
}

}  // namespace

Generator sphere_generator() {
  return shape<40>("sphere", "a closed sphere", 1, "12 * detail^2 triangles",
                   [](const Detail<40>& o) { return sphere_mesh(o.detail); });
}

Generator cube_generator() {
  return shape<1>("cube", "a closed cube", 1, "12 * detail^2 triangles",
                  [](const Detail<1>& o) { return cube_mesh(o.detail); });
}

Generator torus_generator() {
  return shape<64>("torus", "a closed ring", 3, "4 * detail^2 triangles",
                   [](const Detail<64>& o) { return torus_mesh(o.detail); });
}

Generator knot_generator() {
  return shape<32>("knot", "a closed trefoil knot", 3, "16 * detail^2 triangles",
                   [](const Detail<32>& o) { return knot_mesh(o.detail); });
}

}  // namespace boxwood
