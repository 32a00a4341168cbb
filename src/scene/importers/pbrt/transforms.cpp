// Directives that change the current transform.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "scene/importers/pbrt/reader.h"

namespace boxwood::pbrt {
namespace {

/// pbrt lists matrices column by column; what is projective in them is left out.
Transform to_transform(const std::array<float, 16>& m) {
  const float scale = m[15] != 0 ? 1 / m[15] : 1;
  return {Vec3{m[0], m[1], m[2]} * scale, Vec3{m[4], m[5], m[6]} * scale, Vec3{m[8], m[9], m[10]} * scale,
          Vec3{m[12], m[13], m[14]} * scale};
}

}  // namespace

void Reader::apply(const Transform& by) {
  if (moves_start_) now_.to_world = now_.to_world * by;
}

void Reader::identity() {
  if (moves_start_) now_.to_world = {};
}

void Reader::translate() {
  const auto [x, y, z] = tokens().numbers<3>("Translate");
  apply(Transform::translate({x, y, z}));
}

void Reader::scale() {
  const auto [x, y, z] = tokens().numbers<3>("Scale");
  apply(Transform::scale({x, y, z}));
}

void Reader::rotate() {
  const auto [degrees, x, y, z] = tokens().numbers<4>("Rotate");
  const Vec3 axis = normalize({x, y, z});
  if (!(length(axis) > 0)) tokens().fail("Rotate needs an axis that is not zero");
  apply(Transform::rotate(axis, degrees * std::numbers::pi_v<float> / 180));
}

void Reader::look_at() {
  const auto n = tokens().numbers<9>("LookAt");
  const Vec3 eye{n[0], n[1], n[2]}, up = normalize({n[6], n[7], n[8]});
  const Vec3 forward = normalize(Vec3{n[3], n[4], n[5]} - eye), right = cross(up, forward);
  if (!(length(right) > 0))
    tokens().fail("LookAt needs a target away from the eye and an up that is not along the view");
  const Vec3 x = normalize(right);
  apply(Transform{x, cross(forward, x), forward, eye}.inverse());
}

void Reader::transform() {
  const Transform set = to_transform(tokens().numbers<16>("Transform"));
  if (moves_start_) now_.to_world = set;
}

void Reader::concat_transform() { apply(to_transform(tokens().numbers<16>("ConcatTransform"))); }

void Reader::coordinate_system() { coordinate_systems_[tokens().text("a name")] = now_.to_world; }

void Reader::coord_sys_transform() {
  const std::string name = tokens().text("a name");
  const auto found = coordinate_systems_.find(name);
  if (found != coordinate_systems_.end()) {
    now_.to_world = found->second;
    return;
  }
  notes_.add("coordinate system", [&] {
    return fmt::format("{}: the coordinate system '{}' is not defined; the directive was skipped", tokens().place(),
                       name);
  });
}

void Reader::active_transform() {
  const Token token = tokens().next();
  if (token.text != "StartTime" && token.text != "EndTime" && token.text != "All") {
    tokens().fail_expected("StartTime, EndTime or All", token);
  }
  moves_start_ = token.text != "EndTime";
  notes_.add("motion", [&] {
    return fmt::format("{}: motion is not read; everything stands where it starts", tokens().place());
  });
}

void Reader::transform_times() { tokens().numbers<2>("TransformTimes"); }

}  // namespace boxwood::pbrt
