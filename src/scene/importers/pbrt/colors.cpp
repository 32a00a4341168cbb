#include "scene/importers/pbrt/colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace boxwood::pbrt {
namespace {

constexpr float unknown_reflectance = 0.5f;

/// CIE XYZ to linear sRGB (IEC 61966-2-1).
Vec3 from_xyz(const Vec3& c) {
  return {3.2406f * c.x - 1.5372f * c.y - 0.4986f * c.z, -0.9689f * c.x + 1.8758f * c.y + 0.0415f * c.z,
          0.0557f * c.x - 0.2040f * c.y + 1.0570f * c.z};
}

/// Planck's law at 610, 550 and 465 nm, relative to the peak of its curve (Wien).
Vec3 black_body(float kelvin) {
  if (!(kelvin > 0)) return {};
  const double second_constant = 1.438776877e-2, temperature = static_cast<double>(kelvin);
  const auto radiance = [&](double wavelength) {
    return 1 / (std::pow(wavelength * 1e6, 5) * std::expm1(second_constant / (wavelength * temperature)));
  };
  const double peak = radiance(2.897771955e-3 / temperature);
  return {static_cast<float>(radiance(610e-9) / peak), static_cast<float>(radiance(550e-9) / peak),
          static_cast<float>(radiance(465e-9) / peak)};
}

}  // namespace

bool metal_reflectance(std::string_view name, Vec3& reflectance) {
  struct Metal {
    std::string_view name;
    Vec3 reflectance;
  };
  // At right angles, linear sRGB; from measured eta and k (Akenine-Möller et al. 2018, Real-Time Rendering, table 9.2).
  constexpr Metal metals[] = {{"metal-Ag-", {0.972f, 0.960f, 0.915f}},
                              {"metal-Al-", {0.912f, 0.914f, 0.920f}},
                              {"metal-Au-", {1.000f, 0.782f, 0.344f}},
                              {"metal-Cu-", {0.955f, 0.638f, 0.538f}},
                              {"metal-CuZn-", {0.910f, 0.778f, 0.423f}}};
  const auto found = std::ranges::find_if(metals, [&](const Metal& metal) { return name.starts_with(metal.name); });
  if (found == std::end(metals)) return false;
  reflectance = found->reflectance;
  return true;
}

Vec3 Colors::spectrum(const Parameters& parameters, const Parameter& parameter) {
  if (parameter.numbers.size() >= 2 && parameter.numbers.size() % 2 == 0) {
    float sum = 0;
    for (std::size_t i = 1; i < parameter.numbers.size(); i += 2) sum += parameter.numbers[i];
    const std::size_t samples = parameter.numbers.size() / 2;
    return grey(sum / static_cast<float>(samples));
  }
  notes_.add("spectrum", [&] {
    return fmt::format("{}: the spectrum '{}' is not known here; it was taken as 1", parameters.place(),
                       parameter.texts.empty() ? parameter.name : parameter.texts.front());
  });
  return grey(1);
}

Vec3 Colors::texture(const Parameters& parameters, const std::string& name) {
  const auto found = textures_.find(name);
  if (found != textures_.end()) return found->second;
  notes_.add("unknown texture", [&] {
    return fmt::format("{}: the texture '{}' is not defined; it was taken as grey", parameters.place(), name);
  });
  return grey(unknown_reflectance);
}

Vec3 Colors::get(const Parameters& parameters, std::string_view name, const Vec3& otherwise) {
  const Parameter* found = parameters.find(name);
  if (!found) return otherwise;
  if (found->type == "texture") return texture(parameters, parameters.text(name, ""));
  if (found->type == "spectrum") return spectrum(parameters, *found);
  if (found->type == "float") return grey(parameters.number(name, 0));
  if (found->type == "blackbody") {
    const float scale = found->numbers.size() > 1 ? found->numbers[1] : 1;
    return black_body(parameters.number(name, 0)) * scale;
  }
  const Vec3 color = parameters.point(name, otherwise);
  return found->type == "xyz" ? from_xyz(color) : color;
}

float Colors::number(const Parameters& parameters, std::string_view name, float otherwise) {
  const Vec3 color = get(parameters, name, grey(otherwise));
  return (color.x + color.y + color.z) / 3;
}

void Colors::define_texture(const std::string& name, const std::string& class_name, const Parameters& parameters) {
  const Vec3 first = get(parameters, "tex1", grey(1)), second = get(parameters, "tex2", grey(0));
  Vec3 value = grey(unknown_reflectance);
  if (class_name == "constant") {
    value = get(parameters, "value", grey(1));
  } else if (class_name == "scale") {
    value = parameters.has("tex1") ? first * get(parameters, "tex2", grey(1))
                                   : get(parameters, "tex", grey(1)) * get(parameters, "scale", grey(1));
  } else if (class_name == "mix") {
    const float amount = number(parameters, "amount", 0.5f);
    value = first * (1 - amount) + second * amount;
  } else if (class_name == "checkerboard" || class_name == "dots") {
    value = (first + second) * 0.5f;
  } else {
    notes_.add("texture", [&] {
      return fmt::format("{}: textures of the class '{}' are not read; grey took their place", parameters.place(),
                         class_name);
    });
  }
  textures_[name] = value;
}

}  // namespace boxwood::pbrt
