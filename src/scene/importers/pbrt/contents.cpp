// Directives that put something into the scene.
#include <fmt/format.h>

#include <cmath>

#include "scene/cameras.h"
#include "scene/importers/pbrt/lights.h"
#include "scene/importers/pbrt/reader.h"
#include "scene/importers/pbrt/shapes.h"

namespace boxwood::pbrt {

void Reader::camera() {
  const std::string place = tokens().place();
  const std::string type = tokens().text("a camera type");
  const Parameters parameters(tokens());
  if (type != "perspective") {
    notes_.add("camera", [&] {
      return fmt::format("{}: cameras of the type '{}' are not read; a perspective one took its place", place, type);
    });
  }
  const float fov = parameters.number("fov", 90);
  if (!(fov > 0 && fov < 180)) parameters.fail("fov must lie between 0 and 180 degrees");
  const float determinant = now_.to_world.determinant();
  if (!std::isfinite(determinant) || determinant == 0) parameters.fail("the camera's transform has no inverse");
  const Transform to_world = now_.to_world.inverse();
  coordinate_systems_["camera"] = to_world;
  Camera found{"pbrt", to_world.translation, to_world.z, to_world.y, fov};
  // pbrt's camera looks along z, with x to its right.
  found.mirrored = dot(cross(found.direction, found.up), to_world.x) < 0;
  if (!is_finite(found.eye) || !is_finite(found.direction) || !is_finite(found.up)) {
    parameters.fail("the camera's transform is not finite");
  }
  camera_ = found;
}

void Reader::film() {
  tokens().text("a film type");
  const Parameters parameters(tokens());
  const std::int32_t width = parameters.integer("xresolution", 0), height = parameters.integer("yresolution", 0);
  const auto is_side = [](std::int32_t side) {
    return side > 0 && static_cast<std::uint32_t>(side) <= largest_camera_side;
  };
  if (!is_side(width) || !is_side(height)) return;
  width_ = static_cast<std::uint32_t>(width);
  height_ = static_cast<std::uint32_t>(height);
}

void Reader::light_source() {
  const std::string type = tokens().text("a light type");
  const Parameters parameters(tokens());
  if (const auto light = make_light(type, parameters, now_.to_world, colors_, notes_)) lights_.push_back(*light);
}

void Reader::area_light_source() {
  tokens().text("a light type");
  const Parameters parameters(tokens());
  now_.emission = colors_.get(parameters, "L", {1, 1, 1}) * colors_.get(parameters, "scale", {1, 1, 1});
  now_.emits_behind = parameters.flag("twosided", false);
}

void Reader::material() {
  const std::string type = tokens().text("a material type");
  now_.material = materials_.make(type, Parameters(tokens()));
}

void Reader::make_named_material() {
  const std::string name = tokens().text("a material's name");
  const Parameters parameters(tokens());
  materials_.define(name, materials_.make(parameters.text("type", "matte"), parameters));
}

void Reader::named_material() {
  const std::string place = tokens().place();
  now_.material = materials_.named(tokens().text("a material's name"), place);
}

void Reader::texture() {
  const std::string name = tokens().text("a texture's name");
  tokens().text("a texture's type");
  const std::string class_name = tokens().text("a texture's class");
  colors_.define_texture(name, class_name, Parameters(tokens()));
}

void Reader::shape() {
  const std::string type = tokens().text("a shape type");
  const Parameters parameters(tokens());
  if (parameters.has("alpha") || parameters.has("shadowalpha")) {
    notes_.add("alpha", [&] {
      return fmt::format("{}: alpha, which cuts holes into shapes, is not read; they are whole", parameters.place());
    });
  }
  const auto find = [this](const std::string& name, const Parameters& at) { return find_file(name, at.place()); };
  const std::optional<Mesh> mesh = make_shape(type, parameters, find, notes_);
  if (!mesh) return;
  Material used = now_.material;
  used.emission = now_.emission;
  used.emits_behind = now_.emits_behind || now_.emission == Vec3{};
  assembly_.add(*mesh, {now_.to_world, now_.reverse, assembly_.material(used, parameters.place())}, parameters.place());
}

Imported Reader::finish() {
  imported_.scene = assembly_.finish();
  imported_.scene.lights = std::move(lights_);
  if (camera_) {
    camera_->width = width_;
    camera_->height = height_;
    imported_.scene.cameras.push_back(*camera_);
  }
  notes_.report(imported_.scene.notes.messages);
  return std::move(imported_);
}

}  // namespace boxwood::pbrt
