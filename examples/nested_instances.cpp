// Structures placed in structures: leaves on a twig, twigs on trees, trees in a wood; and rays that see some of it.
#include <boxwood/boxwood.h>

#include <cstdio>
#include <exception>
#include <vector>

namespace {

/// `count` placements of part 0 around a circle; every second one has the mask `odd`, the others have every bit.
std::vector<boxwood::Instance> ring(int count, float radius, std::uint32_t odd) {
  std::vector<boxwood::Instance> out;
  for (int i = 0; i < count; ++i) {
    const float angle = 6.2831853f * static_cast<float>(i) / static_cast<float>(count);
    const boxwood::Transform place =
        boxwood::Transform::rotate({0, 0, 1}, angle) * boxwood::Transform::translate({radius, 0, 0});
    out.push_back({0, place, i % 2 == 1 ? odd : boxwood::every_bit});
  }
  return out;
}

}  // namespace

int main() try {
  constexpr std::uint32_t evergreen = 1, summer = 2;
  const boxwood::Structure leaf = boxwood::build(boxwood::load("generate:sphere"));
  const boxwood::Structure twig = boxwood::place(std::vector{leaf}, ring(12, 5, summer));
  const boxwood::Structure tree = boxwood::place(std::vector{twig}, ring(20, 40, boxwood::every_bit));
  const boxwood::Structure wood = boxwood::place(std::vector{tree}, ring(50, 500, boxwood::every_bit));
  std::printf("%u leaves in %zu bytes\n", wood.instance_numbers(), wood.report().bytes);

  // Along the x axis through the outermost leaf.
  const boxwood::Ray ray{.origin = {1000, 0, 0}, .direction = {-1, 0, 0}};
  const boxwood::Hit hit = wood.closest_hit(ray);
  if (!hit.valid()) return 1;
  const std::vector<std::uint32_t> path = wood.instance_path(hit.instance);
  std::printf("t = %g: triangle %u of leaf %u, on twig %u, of tree %u\n", static_cast<double>(hit.t), hit.primitive,
              path[2], path[1], path[0]);
  std::printf("%zu triangles along the ray in summer, %zu in winter\n", wood.all_hits(ray, evergreen | summer).size(),
              wood.all_hits(ray, evergreen).size());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "nested_instances: %s\n", error.what());
  return 1;
}
