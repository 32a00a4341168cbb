#include "study/view_json.h"

#include <nlohmann/json.hpp>

namespace boxwood {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* settings_key = "rays";

Json list(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

}  // namespace

std::string ray_settings_json(const RunSpec& run, const SceneSpec& scene) {
  const RunSpec usual;
  Json out = Json::object();
  if (run.bounces != usual.bounces) out["bounces"] = run.bounces;
  if (run.ao_radius != usual.ao_radius) out["ao_radius"] = run.ao_radius;
  if (run.whole_paths) out["whole_paths"] = {{"ao_rays", run.whole_paths->ao_rays}};
  if (scene.rebuild != 0) out["rebuild"] = scene.rebuild;
  for (const Vec3& light : scene.lights) out["lights"].push_back(list(light));
  return out.dump();
}

std::string view_json(const Camera& camera, const std::string& ray_settings) {
  Json out{
      {"eye", list(camera.eye)}, {"direction", list(camera.direction)}, {"up", list(camera.up)}, {"fov", camera.fov}};
  const Json settings = Json::parse(ray_settings);
  if (!settings.empty()) out[settings_key] = settings;
  return out.dump();
}

bool has_ray_settings(const std::string& view, const std::string& ray_settings) {
  const Json stored = Json::parse(view, nullptr, false);
  const Json settings = stored.is_object() ? stored.value(settings_key, Json::object()) : Json::object();
  return settings.dump() == ray_settings;
}

}  // namespace boxwood
