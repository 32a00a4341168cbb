// A fingerprint of the rendered picture.
#include <bit>

#include "measure/fingerprint.h"
#include "measure/probes/probes.h"
#include "render/render.h"

namespace boxwood {
namespace {

std::vector<Value> measure_image(const ProbeInput& input) {
  if (input.rays->kind != "primary") return {};
  RenderSettings settings;
  settings.camera = input.view.camera;
  settings.width = input.view.width;
  settings.height = input.view.height;
  settings.seed = input.view.seed;
  Fingerprint print;
  for (const Vec3& pixel : render(input.scene, input.structure, settings).image.pixels) {
    for (const float channel : {pixel.x, pixel.y, pixel.z}) print.add(std::bit_cast<std::uint32_t>(channel));
  }
  return {{"image_hash", hash_as_number(print.value())}};
}

}  // namespace

Probe image_probe() {
  return {"image",
          ProbeScope::rays,
          false,
          "a fingerprint of the picture (primary rays only)",
          {{"image_hash", "hash", "the same when the pictures are the same, to the bit"}},
          measure_image};
}

}  // namespace boxwood
