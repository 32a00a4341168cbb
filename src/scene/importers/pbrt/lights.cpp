#include "scene/importers/pbrt/lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace boxwood::pbrt {
namespace {

float cosine_of_degrees(float degrees) { return std::cos(degrees * std::numbers::pi_v<float> / 180); }

void note_picture(const Parameters& parameters, const std::string& type, Notes& notes) {
  if (!parameters.has("mapname") && !parameters.has("filename")) return;
  notes.add("light picture", [&] {
    return fmt::format("{}: pictures of lights are not read; the '{}' light shines evenly", parameters.place(), type);
  });
}

}  // namespace

std::optional<Light> make_light(const std::string& type, const Parameters& parameters, const Transform& to_world,
                                Colors& colors, Notes& notes) {
  Light light;
  const Vec3 scale = colors.get(parameters, "scale", white);
  const Vec3 from = parameters.point("from", {}), to = parameters.point("to", {0, 0, 1});
  const Vec3 along = to_world.vector(to - from);
  light.position = to_world.point(from);
  if (length(along) > 0) light.direction = normalize(along);
  note_picture(parameters, type, notes);
  if (type == "infinite" || type == "exinfinite") {
    light.kind = LightKind::sky;
    light.intensity = colors.get(parameters, "L", white) * scale;
  } else if (type == "distant") {
    light.kind = LightKind::distant;
    light.intensity = colors.get(parameters, "L", white) * scale;
  } else if (type == "spot") {
    light.kind = LightKind::spot;
    light.intensity = colors.get(parameters, "I", white) * scale;
    const float cone = std::clamp(parameters.number("coneangle", 30), 0.0f, 180.0f);
    const float soft = std::clamp(parameters.number("conedeltaangle", 5), 0.0f, cone);
    light.dark_cosine = cosine_of_degrees(cone);
    light.full_cosine = cosine_of_degrees(cone - soft);
  } else if (type == "point" || type == "goniometric" || type == "projection") {
    light.intensity = colors.get(parameters, "I", white) * scale;
  } else {
    notes.add("light " + type, [&] {
      return fmt::format("{}: the light type '{}' is not known here; it was left out", parameters.place(), type);
    });
    return std::nullopt;
  }
  return light;
}

}  // namespace boxwood::pbrt
