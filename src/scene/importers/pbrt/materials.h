#pragma once
#include <map>
#include <string>

#include "boxwood/scene.h"
#include "scene/importers/pbrt/colors.h"
#include "scene/importers/pbrt/notes.h"
#include "scene/importers/pbrt/parameters.h"

namespace boxwood::pbrt {

/// Approximates pbrt's materials, of version 3 and 4, by ours; docs/pbrt.md has the table.
class Materials {
 public:
  Materials(Colors& colors, Notes& notes) : colors_(colors), notes_(notes) {}

  Material make(const std::string& type, const Parameters& parameters);
  void define(const std::string& name, Material material);
  /// A defined one, or a grey one with a note when there is none.
  Material named(const std::string& name, const std::string& place);

 private:
  Material coated(const Parameters& parameters, const Vec3& base, const Vec3& coat, float roughness);
  Material metal(const Parameters& parameters);
  Material glass(const Parameters& parameters);
  Material uber(const Parameters& parameters);
  Material mix(const Parameters& parameters);
  Material disney(const Parameters& parameters);
  /// Fills in the lobe that a rough mirror of that reflectance has.
  void add_gloss(const Parameters& parameters, float roughness, const Vec3& reflectance, Material& material);
  Colors& colors_;
  Notes& notes_;
  std::map<std::string, Material> named_;
};

}  // namespace boxwood::pbrt
