#include "scene/importers/pbrt/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/importers/importer.h"
#include "scene/importers/pbrt/loop_subdivision.h"
#include "scene/importers/pbrt/quadrics.h"

namespace boxwood::pbrt {
namespace {

constexpr std::uint64_t most_subdivided_triangles = std::uint64_t{1} << 26;

/// Groups of `corners` indices into `vertices` positions. Groups that point nowhere are left out with a note.
std::vector<std::array<std::uint32_t, 4>> read_faces(const Parameters& parameters, std::size_t corners,
                                                     std::size_t vertices, Notes& notes) {
  const Parameter* indices = parameters.find("indices");
  std::vector<std::int32_t> single = {0, 1, 2, 3};
  single.resize(corners);
  if (!indices && vertices != corners) parameters.fail("a mesh needs its 'indices'");
  if (indices && indices->integers.size() % corners != 0) {
    parameters.fail(fmt::format("'indices' has {} numbers, which are no whole faces of {} corners",
                                indices->integers.size(), corners));
  }
  const std::vector<std::int32_t>& list = indices ? indices->integers : single;
  std::vector<std::array<std::uint32_t, 4>> faces;
  faces.reserve(list.size() / corners);
  for (std::size_t first = 0; first < list.size(); first += corners) {
    std::array<std::uint32_t, 4> face{};
    bool fits = true;
    for (std::size_t i = 0; i < corners; ++i) {
      const std::int32_t index = list[first + i];
      fits = fits && index >= 0 && static_cast<std::size_t>(index) < vertices;
      face[i] = static_cast<std::uint32_t>(index);
    }
    if (fits) {
      faces.push_back(face);
    } else {
      notes.add("face", [&] {
        return fmt::format("{}: face {} refers to a vertex beyond the {} that there are; it was skipped",
                           parameters.place(), first / corners, vertices);
      });
    }
  }
  return faces;
}

void check_normals(const Parameters& parameters, Mesh& mesh) {
  mesh.normals = parameters.points("N");
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) {
    parameters.fail(fmt::format("there are {} normals for {} points", mesh.normals.size(), mesh.positions.size()));
  }
}

Mesh triangle_mesh(const Parameters& parameters, Notes& notes) {
  Mesh mesh;
  mesh.positions = parameters.points("P");
  check_normals(parameters, mesh);
  for (const auto& face : read_faces(parameters, 3, mesh.positions.size(), notes)) {
    mesh.triangles.push_back({face[0], face[1], face[2]});
  }
  return mesh;
}

/// Patches of four corners in the order of a Z; each becomes two triangles.
Mesh bilinear_mesh(const Parameters& parameters, Notes& notes) {
  Mesh mesh;
  mesh.positions = parameters.points("P");
  check_normals(parameters, mesh);
  for (const auto& face : read_faces(parameters, 4, mesh.positions.size(), notes)) {
    mesh.triangles.push_back({face[0], face[1], face[3]});
    mesh.triangles.push_back({face[0], face[3], face[2]});
  }
  return mesh;
}

Mesh loop_surface(const Parameters& parameters, Notes& notes) {
  Mesh mesh = triangle_mesh(parameters, notes);
  mesh.normals.clear();
  std::int32_t levels = std::max(parameters.integer("levels", parameters.integer("nlevels", 3)), 0);
  const std::int32_t asked = levels;
  while (levels > 0 && (levels > 13 || mesh.triangles.size() << (2 * levels) > most_subdivided_triangles)) --levels;
  if (levels < asked) {
    notes.add("levels", [&] {
      return fmt::format("{}: {} levels of subdivision would make more than 2^26 triangles; {} were done",
                         parameters.place(), asked, levels);
    });
  }
  return subdivide(std::move(mesh), static_cast<std::uint32_t>(levels));
}

Mesh hyperboloid(const Parameters& parameters, float degrees) {
  const Vec3 p1 = parameters.point("p1", {0, 0, 0}), p2 = parameters.point("p2", {1, 1, 1});
  std::vector<ProfilePoint> profile;
  for (std::uint32_t row = 0; row <= half_circle_segments; ++row) {
    const Vec3 p = p1 + (p2 - p1) * (static_cast<float>(row) / half_circle_segments);
    profile.push_back({length({p.x, p.y, 0}), p.z});
  }
  return revolve(profile, degrees);
}

std::optional<Mesh> ply_mesh(const Parameters& parameters, const FindFile& find_file, Notes& notes) {
  const std::optional<std::filesystem::path> file = find_file(parameters.text("filename", ""), parameters);
  if (!file) return std::nullopt;
  std::vector<std::string> messages;
  Mesh mesh = read_ply(*file, messages);
  for (const std::string& message : messages) {
    notes.add("ply", [&] { return message; });
  }
  mesh.texture_coordinates = {};
  return mesh;
}

std::optional<Mesh> quadric(const std::string& type, const Parameters& p) {
  for (const char* name : {"radius", "phimax", "zmin", "zmax", "height", "innerradius"}) {
    if (!std::isfinite(p.number(name, 0))) p.fail(fmt::format("the parameter '{}' must be finite", name));
  }
  const float radius = p.number("radius", 1), degrees = p.number("phimax", 360);
  if (type == "sphere") return sphere(radius, p.number("zmin", -radius), p.number("zmax", radius), degrees);
  if (type == "cylinder") return cylinder(radius, p.number("zmin", -1), p.number("zmax", 1), degrees);
  if (type == "disk") return disk(p.number("height", 0), radius, p.number("innerradius", 0), degrees);
  if (type == "cone") return cone(p.number("height", 1), radius, degrees);
  if (type == "paraboloid") return paraboloid(radius, p.number("zmin", 0), p.number("zmax", 1), degrees);
  if (type == "hyperboloid") return hyperboloid(p, degrees);
  return std::nullopt;
}

}  // namespace

std::optional<Mesh> make_shape(const std::string& type, const Parameters& parameters, const FindFile& find_file,
                               Notes& notes) {
  if (type == "trianglemesh") return triangle_mesh(parameters, notes);
  if (type == "bilinearmesh") return bilinear_mesh(parameters, notes);
  if (type == "loopsubdiv") return loop_surface(parameters, notes);
  if (type == "plymesh") return ply_mesh(parameters, find_file, notes);
  if (std::optional<Mesh> mesh = quadric(type, parameters)) return mesh;
  notes.add("shape " + type,
            [&] { return fmt::format("{}: the shape '{}' is not read; it was left out", parameters.place(), type); });
  return std::nullopt;
}

}  // namespace boxwood::pbrt
