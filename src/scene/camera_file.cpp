// The camera sidecar: {"cameras": [{"name", "eye": [x,y,z], "direction": [x,y,z], "up": [x,y,z], "fov": degrees}]};
// "mirrored": true and "size": [width, height] are optional.
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
const std::vector<std::string> fields = {"name", "eye", "direction", "up", "fov", "mirrored", "size"};

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
    read_optional_fields(camera);
    return camera;
  }

 private:
  void read_optional_fields(Camera& camera) const {
    if (const auto mirrored = json_.find("mirrored"); mirrored != json_.end()) {
      if (!mirrored->is_boolean()) fail("field 'mirrored' must be true or false");
      camera.mirrored = mirrored->get<bool>();
    }
    if (const auto size = json_.find("size"); size != json_.end()) {
      const auto is_side = [](const Json& side) {
        return side.is_number_unsigned() && side >= 1 && side <= largest_camera_side;
      };
      if (!size->is_array() || size->size() != 2 || !is_side((*size)[0]) || !is_side((*size)[1])) {
        fail(fmt::format("field 'size' must be an array of width and height, each 1 to {}", largest_camera_side));
      }
      camera.width = (*size)[0].get<std::uint32_t>();
      camera.height = (*size)[1].get<std::uint32_t>();
    }
  }

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

std::string print_optional_fields(const Camera& camera) {
  std::string text = camera.mirrored ? ", \"mirrored\": true" : "";
  if (camera.width > 0) text += fmt::format(", \"size\": [{}, {}]", camera.width, camera.height);
  return text;
}

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
    text += fmt::format("  {{\"name\": {}, \"eye\": {}, \"direction\": {}, \"up\": {}, \"fov\": {}{}}}{}\n",
                        Json(camera.name).dump(-1, ' ', false, Json::error_handler_t::replace), print(camera.eye),
                        print(camera.direction), print(camera.up), camera.fov, print_optional_fields(camera),
                        i + 1 < cameras.size() ? "," : "");
  }
  text += "]}\n";
  OutputFile out(file);
  out.write(text);
  out.commit();
}

}  // namespace boxwood
