#include <boxwood/boxwood.h>

int main() {
  boxwood::Scene scene;
  scene.add_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const boxwood::Structure bvh = boxwood::build(scene, "default");
  const boxwood::Hit hit = bvh.closest_hit({.origin = {0.25f, 0.25f, -2}, .direction = {0, 0, 1}});
  return hit.valid() && hit.primitive == 0 && hit.t == 2 ? 0 : 1;
}
