// The camera sidecar: {"cameras": [{"name", "eye": [x,y,z], "direction": [x,y,z], "up": [x,y,z], "fov": degrees}]}
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "files/output_file.h"
#include "options/call.h"
#include "options/suggest.h"
#include "scene/cameras.h"
#include "scene/importers/text_file.h"

namespace boxwood {
namespace {

using Json = nlohmann::json;
const std::vector<std::string> fields = {"name", "eye", "direction", "up", "fov"};

/// One camera of the file, with what an error needs to say where it is.
class CameraReader {
 public:
  CameraReader(const Json& json, std::string place) : json_(json), place_(std::move(place)) {}

  Camera read() const {
    if (!json_.is_object()) fail("must be an object");
    for (const auto& [key, value] : json_.items()) {
      if (std::find(fields.begin(), fields.end(), key) == fields.end()) {
        fail(fmt::format("has an unknown field '{}'; {}", key, suggest(key, fields)));
      }
    }
    Camera camera;
    if (!at("name").is_string() || at("name").get_ref<const std::string&>().empty())
      fail("field 'name' must be a text");
    camera.name = at("name").get<std::string>();
    camera.eye = vector("eye");
    camera.direction = vector("direction");
    camera.up = vector("up");
    if (camera.direction == Vec3{} || camera.up == Vec3{}) fail("fields 'direction' and 'up' must not be zero");
    camera.fov = number(at("fov"), "fov");
    if (!(camera.fov > 0 && camera.fov < 180)) fail("field 'fov' must be an angle between 0 and 180 degrees");
    return camera;
  }

 private:
  [[noreturn]] void fail(std::string_view what) const { throw Error(fmt::format("{} {}", place_, what)); }

  const Json& at(const char* field) const {
    const auto found = json_.find(field);
    if (found == json_.end()) fail(fmt::format("lacks the field '{}'", field));
    return *found;
  }

  float number(const Json& value, const char* field) const {
    const double found = value.is_number() ? value.get<double>() : largest_coordinate * 2.0;
    if (std::fabs(found) <= static_cast<double>(largest_coordinate)) return static_cast<float>(found);
    fail(fmt::format("field '{}' must hold numbers of at most {}", field, largest_coordinate));
  }

  Vec3 vector(const char* field) const {
    const Json& value = at(field);
    if (!value.is_array() || value.size() != 3)
      fail(fmt::format("field '{}' must be an array of three numbers", field));
    return {number(value[0], field), number(value[1], field), number(value[2], field)};
  }

  const Json& json_;
  std::string place_;
};

std::string print(const Vec3& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

}  // namespace

std::filesystem::path camera_sidecar(const std::filesystem::path& scene_file) {
  std::filesystem::path sidecar = scene_file;
  sidecar.replace_extension(".cameras.json");
  std::error_code ignored;
  if (std::filesystem::exists(sidecar, ignored)) return sidecar;
  const std::filesystem::path folder = std::filesystem::absolute(scene_file, ignored).parent_path();
  std::filesystem::path beside_folder = folder;
  beside_folder += ".cameras.json";
  return std::filesystem::exists(beside_folder, ignored) ? beside_folder : sidecar;
}

std::vector<Camera> read_cameras(const std::filesystem::path& file) {
  const std::string text = read_whole_file(file), name = file.string();
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) throw Error(fmt::format("{}: is not valid JSON; check brackets, commas and quotes", name));
  if (!json.is_object() || json.size() != 1 || !json.contains("cameras") || !json["cameras"].is_array()) {
    throw Error(fmt::format("{}: must be an object with one field 'cameras', an array", name));
  }
  std::vector<Camera> cameras;
  for (const Json& entry : json["cameras"]) {
    cameras.push_back(CameraReader(entry, fmt::format("{}: camera {}", name, cameras.size() + 1)).read());
    const bool repeated = std::any_of(cameras.begin(), cameras.end() - 1,
                                      [&](const Camera& earlier) { return earlier.name == cameras.back().name; });
    if (repeated) throw Error(fmt::format("{}: two cameras are called '{}'; rename one", name, cameras.back().name));
  }
  return cameras;
}

void write_cameras(const std::filesystem::path& file, std::span<const Camera> cameras) {
  std::string text = "{\"cameras\": [\n";
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const Camera& camera = cameras[i];
    if (!(is_finite(camera.eye) && is_finite(camera.direction) && is_finite(camera.up) && std::isfinite(camera.fov))) {
      throw Error(
          fmt::format("{}: the camera '{}' has a number that is not finite; mend it", file.string(), camera.name));
    }
    text += fmt::format("  {{\"name\": {}, \"eye\": {}, \"direction\": {}, \"up\": {}, \"fov\": {}}}{}\n",
                        Json(camera.name).dump(-1, ' ', false, Json::error_handler_t::replace), print(camera.eye),
                        print(camera.direction), print(camera.up), camera.fov, i + 1 < cameras.size() ? "," : "");
  }
  text += "]}\n";
  OutputFile out(file);
  out.write(text);
  out.commit();
}

}  // namespace boxwood
