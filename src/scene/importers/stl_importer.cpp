// STL triangles. Facet normals follow from the vertices and are passed over; vertices are not joined.
#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "scene/importers/importer.h"
#include "scene/importers/text_file.h"

namespace boxwood {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little endian and copied as it stands");

constexpr std::size_t header_bytes = 84, facet_bytes = 50;

std::uint32_t facets_promised(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + header_bytes - sizeof(count), sizeof(count));
  return count;
}

/// Binary files may begin with "solid" too, but then their size is what their count says.
bool is_ascii(std::string_view bytes) {
  if (!bytes.substr(0, bytes.find_first_not_of(" \t\r\n") + 5).ends_with("solid")) return false;
  return bytes.size() < header_bytes ||
         bytes.size() != header_bytes + std::size_t{facets_promised(bytes)} * facet_bytes;
}

void add_facet(Mesh& mesh, const Vec3 (&corners)[3]) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), corners, corners + 3);
  mesh.triangles.push_back({first, first + 1, first + 2});
}

Mesh read_binary(std::string_view bytes, const std::string& file) {
  if (bytes.size() < header_bytes) {
    throw Error(fmt::format("{}: {} bytes are too few for an STL file; get it again", file, bytes.size()));
  }
  const std::size_t count = facets_promised(bytes), held = (bytes.size() - header_bytes) / facet_bytes;
  if (held < count) {
    throw Error(fmt::format("{}: ends after {} of {} triangles; the file is incomplete or no STL, get it again", file,
                            held, count));
  }
  if (count >= 0xffffffffu / 3) throw Error(fmt::format("{}: has too many triangles for one mesh; split it", file));
  Mesh mesh;
  mesh.positions.reserve(count * 3);
  mesh.triangles.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 corners[3];
    std::memcpy(&corners[0], bytes.data() + header_bytes + i * facet_bytes + sizeof(Vec3), sizeof(corners));
    add_facet(mesh, corners);
  }
  return mesh;
}

void expect(TextCursor& cursor, std::string_view wanted) {
  const std::string_view word = cursor.word_across_lines();
  if (word.empty())
    cursor.fail(fmt::format("ends where '{}' should follow; the file is incomplete, get it again", wanted));
  if (word != wanted) {
    cursor.fail(fmt::format("expected '{}', found '{}'; mend the facet", wanted, word.substr(0, 40)));
  }
}

Vec3 read_vector(TextCursor& cursor) {
  const float x = cursor.number("a coordinate"), y = cursor.number("a coordinate");
  return {x, y, cursor.number("a coordinate")};
}

/// solid … { facet normal x y z  outer loop  vertex x y z (three times)  endloop  endfacet } endsolid …, repeated.
Mesh read_ascii(std::string_view bytes, const std::string& file) {
  Mesh mesh;
  TextCursor cursor(bytes, file);
  bool inside = false;
  for (;;) {
    const std::string_view word = cursor.word_across_lines();
    if (word == "facet") {
      cursor.next_line();
      expect(cursor, "outer");
      expect(cursor, "loop");
      Vec3 corners[3];
      for (Vec3& corner : corners) {
        expect(cursor, "vertex");
        corner = read_vector(cursor);
      }
      expect(cursor, "endloop");
      expect(cursor, "endfacet");
      add_facet(mesh, corners);
    } else if (word == "solid" || word == "endsolid") {
      inside = word == "solid";
      cursor.rest_of_line();
    } else if (word.empty() && !inside) {
      return mesh;
    } else if (word.empty()) {
      cursor.fail("ends without 'endsolid'; the file is incomplete, get it again");
    } else {
      cursor.fail(fmt::format("expected 'facet' or 'endsolid', found '{}'", word.substr(0, 40)));
    }
  }
}

}  // namespace

Imported import_stl(const std::filesystem::path& file) {
  const std::string bytes = read_whole_file(file);
  Imported imported{{}, {file}};
  imported.scene.meshes.push_back(is_ascii(bytes) ? read_ascii(bytes, file.string())
                                                  : read_binary(bytes, file.string()));
  imported.scene.instances.push_back({0, {}});
  return imported;
}

}  // namespace boxwood
