#include <limits>

#include "temporary_folder.h"

namespace boxwood {
namespace {

using Obj = TemporaryFolder;

TEST_F(Obj, FacesKeepTheOrderOfTheFileAndPolygonsAreCut) {
  const Scene scene =
      load_text("a.obj",
                "# comment\nv 0 0 0\nv 1 0 0\nv 1 1 .5\nv 0 1 0\r\nf 1 2 3\nf 1 2 3 4\nf -1 -2 \\\n -3\n"
                "f 1 1 2\n");
  ASSERT_TRUE(scene.single_level());
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.positions, square);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {3, 2, 1}, {0, 0, 1}}));
  EXPECT_EQ(scene.notes.degenerate_triangles, 1u);
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.texture_coordinates.empty());
  EXPECT_TRUE(mesh.materials.empty());
}

TEST_F(Obj, AConcavePolygonIsCutInsideItself) {
  // An L of area 3; a fan from its first corner would cover 5.
  const Scene scene = load_text("l.obj", "v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nf 1 2 3 4 5 6\n");
  const Mesh& mesh = scene.meshes[0];
  ASSERT_EQ(mesh.triangles.size(), 4u);
  float area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    area += length(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a])) / 2;
  }
  EXPECT_FLOAT_EQ(area, 3);
}

TEST_F(Obj, CornersThatDifferInAttributesBecomeVerticesOfTheirOwn) {
  const Scene scene = load_text("n.obj",
                                "v 0 0 0\nv 1 0 0\nv 1 1 .5\nv 0 1 0\nvt 0 0\nvt 1 0.25\nvn 0 0 1\nvn 0 1 0\n"
                                "f 1/1/1 2/2/1 3/1/1\nf 1/1/1 3/1/2 4//2\n");
  const Mesh& mesh = scene.meshes[0];
  ASSERT_EQ(mesh.positions.size(), 5u);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 3, 4}}));
  EXPECT_EQ(mesh.positions[2], mesh.positions[3]);
  EXPECT_EQ(mesh.normals[3], (Vec3{0, 1, 0}));
  EXPECT_EQ(mesh.texture_coordinates[1], (std::array<float, 2>{1, 0.25f}));
  EXPECT_EQ(mesh.texture_coordinates[4], (std::array<float, 2>{0, 0}));
}

TEST_F(Obj, MaterialsComeFromTheMaterialFile) {
  write("m.mtl",
        "newmtl red wall\nKd 1 0 0\nNs 10\nd 0.5\nTr 0\nNi 1.5\nmap_Kd brick.png\nnewmtl lamp\nKe 5\nKs .1 .2 .3\n");
  const Scene scene =
      load_text("m.obj",
                "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nusemtl lamp\nf 1 2 3\nusemtl red wall\n"
                "f 1 2 3\nusemtl none\nf 1 2 3\n");
  EXPECT_EQ(scene.meshes[0].materials, (std::vector<std::uint16_t>{2, 1, 0, 3}));
  ASSERT_EQ(scene.materials.size(), 4u);
  const Material &red = scene.materials[0], &lamp = scene.materials[1];
  EXPECT_EQ(red.name, "red wall");
  EXPECT_EQ(red.diffuse, (Vec3{0.5f, 0, 0}));
  EXPECT_EQ(red.transmission, (Vec3{0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(red.refraction_index, 1.5f);
  EXPECT_EQ(red.shininess, 10);
  EXPECT_EQ(lamp.emission, (Vec3{5, 5, 5}));
  EXPECT_EQ(lamp.specular, (Vec3{0.1f, 0.2f, 0.3f}));
  ASSERT_EQ(scene.notes.messages.size(), 2u);
  EXPECT_NE(scene.notes.messages[0].find("m.obj:10: the material 'none' is not defined"), std::string::npos);
  EXPECT_NE(scene.notes.messages[1].find("brick.png: the texture is missing"), std::string::npos);
}

TEST_F(Obj, IlluminationModelsMakeMirrorsAndGlass) {
  write("m.mtl",
        "newmtl mirror\nillum 5\nKs .9 .9 .9\nnewmtl glass\nKs .3 .3 .3\nNi 2.5\nillum 7\nnewmtl gloss\nKs 1\n");
  const Scene scene = load_text("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl glass\nf 1 2 3\n");
  ASSERT_EQ(scene.materials.size(), 3u);
  EXPECT_EQ(scene.materials[0].reflection, (Vec3{0.9f, 0.9f, 0.9f}));
  EXPECT_EQ(scene.materials[0].specular, (Vec3{}));
  EXPECT_EQ(scene.materials[1].transmission, (Vec3{1, 1, 1}));
  EXPECT_EQ(scene.materials[1].refraction_index, 2.5f);
  EXPECT_EQ(scene.materials[2].specular, (Vec3{1, 1, 1}));
}

TEST_F(Obj, AMissingMaterialFileIsNoted) {
  const Scene scene = load_text("m.obj", "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  ASSERT_EQ(scene.notes.messages.size(), 1u);
  EXPECT_NE(scene.notes.messages[0].find("m.obj:1: the material file 'gone.mtl' is missing"), std::string::npos);
}

TEST_F(Obj, FacesThatReferToNothingAreSkippedAndNotedOnce) {
  const Scene scene =
      load_text("b.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\nf 1 2 3\nf 0 1 2\nf 1 -4 2\nf 1 2\nl 1 2\n");
  EXPECT_EQ(scene.meshes[0].triangles.size(), 1u);
  ASSERT_EQ(scene.notes.messages.size(), 3u);
  EXPECT_NE(
      scene.notes.messages[0].find("b.obj:4: face refers to vertex 9 of 3; the face was skipped (2 more like it)"),
      std::string::npos);
  EXPECT_NE(scene.notes.messages[1].find("b.obj:8: face has 2 corners"), std::string::npos);
  EXPECT_NE(scene.notes.messages[2].find("b.obj:9: points, lines"), std::string::npos);
}

TEST_F(Obj, NumbersThatAreNotFiniteAreCounted) {
  const Scene scene = load_text(
      "i.obj",
      "v nan 0 0\nv 1 0 0\nv 1 1 0\nv 1e400 0 0\nv 2e12 0 0\nv 1e-400 0 +1\nf 1 2 3\nf 2 3 4\nf 2 3 5\nf 2 3 6\n");
  EXPECT_EQ(scene.notes.non_finite_triangles, 3u);
  EXPECT_EQ(scene.meshes[0].positions.back(), (Vec3{0, 0, 1}));
}

TEST_F(Obj, NumbersWithoutExponentMayBeOutOfRangeToo) {
  const std::string zeros(400, '0');
  const Scene scene = load_text("z.obj", "v 0." + zeros + "1 -0." + zeros + "1 1\nv -1" + zeros + " 0 0\nf 1 1 2\n");
  EXPECT_EQ(scene.meshes[0].positions[0], (Vec3{0, 0, 1}));
  EXPECT_EQ(scene.meshes[0].positions[1].x, -std::numeric_limits<float>::infinity());
}

TEST_F(Obj, BrokenLinesAreNamed) {
  const std::pair<std::string, std::string> cases[] = {
      {"v 0 0\nf 1 1 1\n", "x.obj:1: expected a coordinate, found the end of the line"},
      {"v 0 0 0\nv a 0 0\n", "x.obj:2: expected a coordinate, found 'a'"},
      {"v 0 0 0\nf 1 x 1\n", "x.obj:2: 'x' is no corner of a face"},
      {"v 0 0 0\nvt 0 0\nf 1 /1 1\n", "x.obj:3: the corner '/1' of a face names no vertex"},
      {std::string("\0\1\2\377garbage", 11), "x.obj: has no vertices"},
  };
  for (const auto& [text, expected] : cases) {
    const std::string told = refusal("x.obj", text);
    EXPECT_NE(told.find(expected), std::string::npos) << "'" << told << "' for " << text;
    EXPECT_TRUE(is_one_sentence(told, path("x.obj")));
  }
}

TEST_F(Obj, WithoutFacesIsAnEmptySceneWithANote) {
  const Scene scene = load_text("p.obj", "v 0 0 0\nv 1 0 0\n");
  EXPECT_TRUE(scene.empty());
  ASSERT_EQ(scene.notes.messages.size(), 1u);
  EXPECT_NE(scene.notes.messages[0].find("p.obj: has no triangles"), std::string::npos);
  EXPECT_EQ(scene.cameras.back().name, "auto");
}

}  // namespace
}  // namespace boxwood
