// Materials of Wavefront OBJ files: colours, shininess, opacity, refraction and mirrors; of textures the diffuse one.
#include <algorithm>

#include "scene/importers/importer.h"
#include "scene/importers/text_file.h"
#include "scene/texture_file.h"

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

/// The file that a map names: what follows its options, whose arguments are numbers, "on" or "off". Empty: none.
std::string map_file(TextCursor& cursor) {
  TextCursor ahead = cursor;
  std::string_view word = ahead.word();
  while (word.starts_with('-')) {
    const bool named = word == "-imfchan" || word == "-type";
    cursor.word();
    word = ahead.word();
    double ignored = 0;
    for (bool first = true; parse_number(word, ignored) || word == "on" || word == "off" || (named && first);
         first = false) {
      cursor.word();
      word = ahead.word();
    }
  }
  std::string name(cursor.rest_of_line());
  std::ranges::replace(name, '\\', '/');
  return name;
}

/// What a material is made of only once all of its statements are known.
struct Optics {
  float opacity = 1;
  bool has_opacity = false;
  float illumination_model = 2;
};

void read_statement(TextCursor& cursor, std::string_view keyword, Material& material, Optics& optics,
                    const std::filesystem::path& folder, Scene& scene) {
  if (keyword == "Kd") {
    read_color(cursor, material.diffuse);
  } else if (keyword == "map_Kd") {
    if (const std::string name = map_file(cursor); !name.empty()) material.texture = add_texture(scene, folder / name);
  } else if (keyword == "Ke") {
    read_color(cursor, material.emission);
  } else if (keyword == "Ks") {
    read_color(cursor, material.specular);
  } else if (keyword == "Ns") {
    material.shininess = cursor.number("a shininess");
  } else if (keyword == "Ni") {
    material.refraction_index = cursor.number("a refraction index");
  } else if (keyword == "d") {
    optics.opacity = std::clamp(cursor.number("an opacity"), 0.0f, 1.0f);
    optics.has_opacity = true;
  } else if (keyword == "Tr" && !optics.has_opacity) {
    optics.opacity = std::clamp(1 - cursor.number("a transparency"), 0.0f, 1.0f);
  } else if (keyword == "illum") {
    optics.illumination_model = cursor.number("an illumination model");
  }
}

/// Illumination models 3, 5 and 8 are mirrors, 6 and 7 refract; of the others, what is not opaque lets light through.
void apply(const Optics& optics, Material& material) {
  const float model = optics.illumination_model;
  if (model == 3 || model == 5 || model == 8) {
    material.reflection = material.specular;
    material.specular = {};
  } else if (model == 6 || model == 7) {
    material.reflection = material.transmission = {1, 1, 1};
    material.specular = {};
  } else if (optics.opacity < 1) {
    material.diffuse = material.diffuse * optics.opacity;
    material.specular = material.specular * optics.opacity;
    material.transmission = Vec3{1, 1, 1} * (1 - optics.opacity);
  }
}

}  // namespace

std::vector<Material> read_mtl(const std::filesystem::path& file, Scene& scene) {
  const std::string text = read_whole_file(file);
  std::vector<Material> materials;
  Optics optics;
  const auto finish = [&] {
    if (!materials.empty()) apply(optics, materials.back());
    optics = {};
  };
  for (TextCursor cursor(text, file.string()); !cursor.at_end(); cursor.next_line()) {
    const std::string_view keyword = cursor.word();
    if (keyword == "newmtl") {
      finish();
      materials.emplace_back().name = cursor.rest_of_line();
    } else if (!materials.empty()) {
      read_statement(cursor, keyword, materials.back(), optics, file.parent_path(), scene);
    }
  }
  finish();
  return materials;
}

}  // namespace boxwood
