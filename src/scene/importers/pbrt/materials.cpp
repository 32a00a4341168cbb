#include "scene/importers/pbrt/materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace boxwood::pbrt {
namespace {

constexpr float smoothest_alpha = 0.02f;  // below, a rough mirror looks like a smooth one

Material diffuse_only(const Vec3& color) {
  Material material;
  material.diffuse = color;
  return material;
}

/// Fresnel reflectance at right angles of a dielectric, and of a conductor with absorption k.
float reflectance(float eta) { return (eta - 1) * (eta - 1) / ((eta + 1) * (eta + 1)); }
float reflectance(float eta, float k) {
  return ((eta - 1) * (eta - 1) + k * k) / std::max((eta + 1) * (eta + 1) + k * k, 1e-12f);
}

Material blend(const Material& a, const Material& b, float share_of_b) {
  const auto mixed = [&](const Vec3& x, const Vec3& y) { return x * (1 - share_of_b) + y * share_of_b; };
  Material out = share_of_b < 0.5f ? a : b;
  out.diffuse = mixed(a.diffuse, b.diffuse);
  out.specular = mixed(a.specular, b.specular);
  out.reflection = mixed(a.reflection, b.reflection);
  out.transmission = mixed(a.transmission, b.transmission);
  if (a.specular == Vec3{} || b.specular == Vec3{}) out.shininess = std::max(a.shininess, b.shininess);
  if (a.transmission == Vec3{}) out.refraction_index = b.refraction_index;
  if (b.transmission == Vec3{}) out.refraction_index = a.refraction_index;
  return out;
}

}  // namespace

void Materials::define(const std::string& name, Material material) {
  material.name = name;
  named_[name] = std::move(material);
}

Material Materials::named(const std::string& name, const std::string& place) {
  const auto found = named_.find(name);
  if (found != named_.end()) return found->second;
  notes_.add("unknown material", [&] {
    return fmt::format("{}: the material '{}' is not defined; a grey one took its place", place, name);
  });
  return diffuse_only(grey(0.5f));
}

void Materials::add_gloss(const Parameters& parameters, float roughness, const Vec3& reflected, Material& material) {
  const float both = colors_.number(parameters, "roughness", roughness);
  const float u = colors_.number(parameters, "uroughness", both), v = colors_.number(parameters, "vroughness", both);
  const float mean = std::max((u + v) / 2, 0.0f);
  const float alpha = parameters.flag("remaproughness", true) ? std::sqrt(mean) : mean;
  if (alpha < smoothest_alpha) {
    material.reflection = reflected;
  } else {
    material.specular = reflected;
    material.shininess = std::max(2 / (alpha * alpha) - 2, 1.0f);  // Walter et al. 2007: Phong of a Beckmann alpha
  }
}

Material Materials::coated(const Parameters& parameters, const Vec3& base, const Vec3& coat, float roughness) {
  Material material = diffuse_only(base * (white - min(coat, white)));
  add_gloss(parameters, roughness, coat, material);
  return material;
}

Material Materials::metal(const Parameters& parameters) {
  Material material = diffuse_only({});
  Vec3 reflected;
  const Parameter* eta_parameter = parameters.find("eta");
  const bool named = eta_parameter && !eta_parameter->texts.empty() && eta_parameter->type == "spectrum";
  if (parameters.has("reflectance")) {
    reflected = colors_.get(parameters, "reflectance", white);
  } else if (!eta_parameter) {
    metal_reflectance("metal-Cu-", reflected);
  } else if (!named || !metal_reflectance(eta_parameter->texts.front(), reflected)) {
    const Vec3 eta = colors_.get(parameters, "eta", white), k = colors_.get(parameters, "k", grey(3));
    reflected = {reflectance(eta.x, k.x), reflectance(eta.y, k.y), reflectance(eta.z, k.z)};
  }
  add_gloss(parameters, 0, reflected, material);
  return material;
}

Material Materials::glass(const Parameters& parameters) {
  Material material = diffuse_only({});
  const float index = colors_.number(parameters, "eta", colors_.number(parameters, "index", 1.5f));
  material.refraction_index = index > 0 ? index : 1.5f;
  material.reflection = colors_.get(parameters, "Kr", white);
  material.transmission = colors_.get(parameters, "Kt", white);
  if (material.transmission == Vec3{}) material.reflection = material.reflection * reflectance(index);
  return material;
}

Material Materials::uber(const Parameters& parameters) {
  const Vec3 opacity = min(max(colors_.get(parameters, "opacity", white), {}), white);
  Material material = diffuse_only(colors_.get(parameters, "Kd", grey(0.25f)) * opacity);
  add_gloss(parameters, 0.1f, colors_.get(parameters, "Ks", grey(0.25f)) * opacity, material);
  material.reflection += colors_.get(parameters, "Kr", {}) * opacity;
  material.transmission = white - opacity + colors_.get(parameters, "Kt", {}) * opacity;
  return material;
}

Material Materials::mix(const Parameters& parameters) {
  const Parameter* list = parameters.find("materials");
  const auto pick = [&](std::size_t number, const char* old_name) {
    if (!list) return named(parameters.text(old_name, ""), parameters.place());
    return named(number < list->texts.size() ? list->texts[number] : "", parameters.place());
  };
  const float amount = std::clamp(colors_.number(parameters, "amount", 0.5f), 0.0f, 1.0f);
  // Version 3 gives the share of the first, version 4 that of the second.
  return blend(pick(0, "namedmaterial1"), pick(1, "namedmaterial2"), list ? amount : 1 - amount);
}

Material Materials::disney(const Parameters& parameters) {
  const Vec3 color = colors_.get(parameters, "color", grey(0.5f));
  const float metallic = std::clamp(colors_.number(parameters, "metallic", 0), 0.0f, 1.0f);
  Material material = diffuse_only(color * ((1 - metallic) * 0.96f));
  add_gloss(parameters, 0.5f, color * metallic + grey(0.04f * (1 - metallic)), material);
  return material;
}

Material Materials::make(const std::string& type, const Parameters& p) {
  const auto color = [&](const char* name, float otherwise) { return colors_.get(p, name, grey(otherwise)); };
  if (type == "matte") return diffuse_only(color("Kd", 0.5f));
  if (type == "diffuse") return diffuse_only(color("reflectance", 0.5f));
  if (type == "plastic") return coated(p, color("Kd", 0.25f), color("Ks", 0.25f), 0.1f);
  if (type == "substrate") return coated(p, color("Kd", 0.5f), color("Ks", 0.5f), 0.1f);
  if (type == "coateddiffuse") {
    return coated(p, color("reflectance", 0.5f), grey(reflectance(colors_.number(p, "eta", 1.5f))), 0);
  }
  if (type == "uber") return uber(p);
  if (type == "metal" || type == "conductor" || type == "coatedconductor") return metal(p);
  if (type == "glass" || type == "dielectric") return glass(p);
  if (type == "mix") return mix(p);
  if (type == "disney") return disney(p);
  if (type == "mirror") {
    Material material = diffuse_only({});
    material.reflection = color("Kr", 0.9f);
    return material;
  }
  if (type == "thindielectric") {
    const float once = reflectance(colors_.number(p, "eta", 1.5f));
    Material material = diffuse_only({});
    material.reflection = grey(2 * once / (1 + once));  // all reflections between the two sides
    material.transmission = white - material.reflection;
    return material;
  }
  if (type == "interface" || type == "none" || type.empty()) {
    Material material = diffuse_only({});
    material.transmission = white;
    return material;
  }
  if (type == "translucent") return diffuse_only(color("Kd", 0.25f));
  if (type == "diffusetransmission") return diffuse_only(color("reflectance", 0.25f) + color("transmittance", 0.25f));
  notes_.add("material " + type, [&] {
    return fmt::format("{}: the material type '{}' is not known here; a diffuse one took its place", p.place(), type);
  });
  return diffuse_only(p.has("Kd") ? color("Kd", 0.5f) : color("reflectance", 0.5f));
}

}  // namespace boxwood::pbrt
