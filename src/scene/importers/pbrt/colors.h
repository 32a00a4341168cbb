#pragma once
#include <map>
#include <string>

#include "boxwood/vec3.h"
#include "scene/importers/pbrt/notes.h"
#include "scene/importers/pbrt/parameters.h"

namespace boxwood::pbrt {

inline constexpr Vec3 white{1, 1, 1};
inline Vec3 grey(float value) { return {value, value, value}; }

/// Colours of parameters, textures included, each of which is replaced by one colour.
class Colors {
 public:
  explicit Colors(Notes& notes) : notes_(notes) {}

  /// A colour given as rgb, xyz, spectrum, black body, grey number or texture.
  Vec3 get(const Parameters& parameters, std::string_view name, const Vec3& otherwise);
  /// A number or a texture's mean.
  float number(const Parameters& parameters, std::string_view name, float otherwise);
  /// Defines a texture: `class_name` is "constant", "scale", "imagemap", …
  void define_texture(const std::string& name, const std::string& class_name, const Parameters& parameters);

 private:
  Vec3 texture(const Parameters& parameters, const std::string& name);
  Vec3 spectrum(const Parameters& parameters, const Parameter& parameter);
  Notes& notes_;
  std::map<std::string, Vec3> textures_;
};

/// Reflectance at right angles of a conductor whose spectra are named "metal-NAME-eta" and so on; false for others.
bool metal_reflectance(std::string_view spectrum_name, Vec3& reflectance);

}  // namespace boxwood::pbrt
