// Materials of Wavefront OBJ files: colours, shininess, opacity and refraction index; textures are passed over.
#include <algorithm>

#include "scene/importers/importer.h"
#include "scene/importers/text_file.h"

namespace boxwood {
namespace {

/// One number means grey. "spectral" and "xyz" colours stay as they were.
void read_color(TextCursor& cursor, Vec3& color) {
  TextCursor ahead = cursor;
  const std::string_view first = ahead.word();
  if (first == "spectral" || first == "xyz") return;
  color.x = cursor.number("a colour");
  ahead = cursor;
  const bool grey = ahead.word().empty();
  color.y = grey ? color.x : cursor.number("a colour");
  color.z = grey ? color.x : cursor.number("a colour");
}

void read_statement(TextCursor& cursor, std::string_view keyword, Material& material, bool& has_opacity) {
  if (keyword == "Kd") {
    read_color(cursor, material.diffuse);
  } else if (keyword == "Ke") {
    read_color(cursor, material.emission);
  } else if (keyword == "Ks") {
    read_color(cursor, material.specular);
  } else if (keyword == "Ns") {
    material.shininess = cursor.number("a shininess");
  } else if (keyword == "Ni") {
    material.refraction_index = cursor.number("a refraction index");
  } else if (keyword == "d") {
    material.opacity = std::clamp(cursor.number("an opacity"), 0.0f, 1.0f);
    has_opacity = true;
  } else if (keyword == "Tr" && !has_opacity) {
    material.opacity = std::clamp(1 - cursor.number("a transparency"), 0.0f, 1.0f);
  }
}

}  // namespace

std::vector<Material> read_mtl(const std::filesystem::path& file) {
  const std::string text = read_whole_file(file);
  std::vector<Material> materials;
  bool has_opacity = false;
  for (TextCursor cursor(text, file.string()); !cursor.at_end(); cursor.next_line()) {
    const std::string_view keyword = cursor.word();
    if (keyword == "newmtl") {
      materials.emplace_back().name = cursor.rest_of_line();
      has_opacity = false;
    } else if (!materials.empty()) {
      read_statement(cursor, keyword, materials.back(), has_opacity);
    }
  }
  return materials;
}

}  // namespace boxwood
