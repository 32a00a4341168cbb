#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>

#include "scene/temporary_folder.h"

namespace boxwood {
namespace {

using Pbrt = TemporaryFolder;

const std::string triangle = R"(Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [0 0 0  1 0 0  0 1 0])";

std::string gzipped(const std::string& path, const std::string& bytes) {
  gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(file);
  return path;
}

std::string triangle_ply() {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
}

bool notes_contain(const Scene& scene, const std::string& text) {
  for (const std::string& message : scene.notes.messages) {
    if (message.find(text) != message.npos) return true;
  }
  return false;
}

void expect_near(const Vec3& a, const Vec3& b, float tolerance = 1e-5f) {
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], tolerance) << "axis " << axis;
}

TEST_F(Pbrt, TransformsApplyInnermostFirst) {
  const Scene scene =
      load_text("a.pbrt", "WorldBegin\nAttributeBegin\nTranslate 10 0 0 Scale 2 2 2 Rotate 90 0 0 1 # turned\n" +
                              triangle + "\nAttributeEnd\n" + triangle + "\nWorldEnd\n");
  ASSERT_TRUE(scene.single_level());
  const Mesh& mesh = scene.meshes[0];
  ASSERT_EQ(mesh.triangles.size(), 2u);
  expect_near(mesh.positions[1], {10, 2, 0});
  expect_near(mesh.positions[2], {8, 0, 0});
  expect_near(mesh.positions[4], {1, 0, 0});
}

TEST_F(Pbrt, MatricesAreListedColumnByColumn) {
  const Scene scene = load_text(
      "a.pbrt",
      "Transform [0 1 0 0  -1 0 0 0  0 0 1 0  5 6 7 1]\nConcatTransform [2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1]" + triangle);
  expect_near(scene.meshes[0].positions[0], {5, 6, 7});
  expect_near(scene.meshes[0].positions[1], {5, 8, 7});
  expect_near(scene.meshes[0].positions[2], {3, 6, 7});
}

TEST_F(Pbrt, NamedCoordinateSystemsAndTransformScopesBringTransformsBack) {
  const Scene scene =
      load_text("a.pbrt",
                "WorldBegin Translate 1 0 0 CoordinateSystem \"here\" TransformBegin Translate 5 5 5 "
                "TransformEnd " +
                    triangle + " Identity CoordSysTransform \"here\" " + triangle + " CoordSysTransform \"nowhere\" ");
  expect_near(scene.meshes[0].positions[0], {1, 0, 0});
  expect_near(scene.meshes[0].positions[3], {1, 0, 0});
  EXPECT_TRUE(notes_contain(scene, "a.pbrt:1: the coordinate system 'nowhere' is not defined"));
}

TEST_F(Pbrt, CameraIsTheInverseOfItsTransform) {
  const Scene scene = load_text("c.pbrt",
                                "Scale -1 1 1 LookAt 3 4 5  3 4 9  0 1 0\nCamera \"perspective\" \"float fov\" 40\n"
                                "Film \"rgb\" \"integer xresolution\" 320 \"integer yresolution\" [200]\nWorldBegin\n");
  const Camera& camera = scene.cameras.front();
  expect_near(camera.eye, {3, 4, 5});
  expect_near(normalize(camera.direction), {0, 0, 1});
  expect_near(normalize(camera.up), {0, 1, 0});
  EXPECT_EQ(camera.fov, 40);
  EXPECT_EQ(camera.width, 320u);
  EXPECT_EQ(camera.height, 200u);
  EXPECT_FALSE(camera.mirrored);
  const Scene left_handed = load_text("d.pbrt", "LookAt 3 4 5  3 4 9  0 1 0\nCamera \"perspective\"\nWorldBegin\n");
  EXPECT_TRUE(left_handed.cameras.front().mirrored);
  EXPECT_EQ(left_handed.cameras.front().fov, 90);
}

TEST_F(Pbrt, ObjectsPlacedSeveralTimesStayInstances) {
  const std::string object = "ObjectBegin \"tree\" Translate 0 0 1 " + triangle + " ObjectEnd\n";
  const Scene scene = load_text("o.pbrt", object + triangle +
                                              "\nTranslate 5 0 0 ObjectInstance \"tree\"\nScale -1 1 1 "
                                              "ObjectInstance \"tree\" ObjectInstance \"bush\"");
  ASSERT_EQ(scene.meshes.size(), 2u);
  ASSERT_EQ(scene.instances.size(), 3u);
  expect_near(scene.meshes[1].positions[0], {0, 0, 1});
  expect_near(scene.instances[1].object_to_world.point({1, 0, 0}), {6, 0, 0});
  expect_near(scene.instances[2].object_to_world.point({1, 0, 0}), {4, 0, 0});
  EXPECT_TRUE(notes_contain(scene, "o.pbrt:4: the object 'bush' is not defined"));
}

TEST_F(Pbrt, ObjectsInsideObjectsAreMultipliedOut) {
  const Scene scene = load_text(
      "n.pbrt",
      "ObjectBegin \"leaf\" " + triangle +
          " ObjectEnd ObjectBegin \"twig\" Translate 0 0 1 ObjectInstance \"leaf\" Translate 0 0 1 "
          "ObjectInstance \"leaf\" ObjectEnd Translate 10 0 0 ObjectInstance \"twig\" ObjectInstance \"twig\"");
  EXPECT_EQ(scene.unique_triangles(), 1u);
  ASSERT_EQ(scene.instances.size(), 4u);
  expect_near(scene.instances[1].object_to_world.translation, {10, 0, 2});
}

TEST_F(Pbrt, FrontsFollowNormalsMirrorsAndReverseOrientation) {
  const auto normal_of = [&](const std::string& before, const std::string& after) {
    const Scene scene = load_text("f.pbrt", before + triangle + after);
    const Mesh& mesh = scene.meshes[0];
    const auto& [a, b, c] = mesh.triangles[0];
    return cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]).z;
  };
  EXPECT_GT(normal_of("", ""), 0);
  EXPECT_LT(normal_of("ReverseOrientation ", ""), 0);
  EXPECT_GT(normal_of("Scale 1 1 -1 ReverseOrientation ", ""), 0);
  EXPECT_LT(normal_of("", "\"normal N\" [0 0 -1 0 0 -1 0 0 -1]"), 0);
}

TEST_F(Pbrt, IncludesAreReadFromTheFolderOfTheFirstFile) {
  std::filesystem::create_directories(path("parts"));
  write("parts/inner.pbrt", triangle);
  write("parts/outer.pbrt", "Translate 0 0 3 Include \"parts/inner.pbrt\"");
  const Scene scene =
      load_text("i.pbrt", "Include \"parts/outer.pbrt\"\n" + triangle + "\nIdentity Import \"parts/outer.pbrt\"\n" +
                              triangle + "Include \"gone.pbrt\" Include \"gone.pbrt\"");
  const Mesh& mesh = scene.meshes[0];
  ASSERT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.positions[3].z, 3) << "an included file's transform lasts";
  EXPECT_EQ(mesh.positions[9].z, 0) << "an imported file's does not";
  EXPECT_TRUE(notes_contain(scene, "i.pbrt:4: the file 'gone.pbrt' is missing"));
}

TEST_F(Pbrt, PlyMeshesMayBeCompressedAndMissingOnesAreCountedOnce) {
  write("a.ply", triangle_ply());
  gzipped(path("b.ply.gz"), triangle_ply());
  const std::string ply = "Shape \"plymesh\" \"string filename\" ";
  const Scene scene = load_text("p.pbrt", ply + "\"a.ply\"\n" + ply + "[\"b.ply.gz\"]\n" + ply + "\"c.ply\"\n" + ply +
                                              "\"c.ply\"\n" + ply + "\"d.ply\"\n");
  EXPECT_EQ(scene.unique_triangles(), 2u);
  EXPECT_TRUE(notes_contain(scene, "p.pbrt:3: the file 'c.ply' is missing; it was left out (1 more like it)"));
  EXPECT_EQ(load(path("b.ply.gz")).unique_triangles(), 1u);
}

TEST_F(Pbrt, CompressedScenesAreRead) { EXPECT_EQ(load(gzipped(path("z.pbrt.gz"), triangle)).unique_triangles(), 1u); }

TEST_F(Pbrt, MaterialsOfBothVersionsAreApproximated) {
  const Scene scene = load_text("m.pbrt", R"(
MakeNamedMaterial "wall" "string type" "matte" "rgb Kd" [.1 .2 .3]
Texture "half" "spectrum" "constant" "rgb value" [.4 .4 .4]
NamedMaterial "wall" )" + triangle + R"(
Material "coateddiffuse" "texture reflectance" "half" "float roughness" .25 )" +
                                              triangle + R"(
Material "mirror" )" + triangle + R"(
Material "dielectric" "float eta" 1.33 )" + triangle +
                                              R"(
Material "conductor" "spectrum eta" "metal-Ag-eta" "spectrum k" "metal-Ag-k" "float roughness" 0 )" +
                                              triangle + R"(
Material "uber" "rgb Kd" [1 1 1] "rgb Ks" [0 0 0] "rgb opacity" [.5 .5 .5] )" +
                                              triangle + R"(
Material "velvet" "rgb Kd" [.7 .7 .7] )" + triangle +
                                              R"(
NamedMaterial "wall" )" + triangle + R"(
NamedMaterial "nothing" )" + triangle);
  const auto of = [&](std::size_t number) { return scene.materials[scene.meshes[0].materials[number]]; };
  EXPECT_EQ(of(0).diffuse, (Vec3{.1f, .2f, .3f}));
  expect_near(of(1).diffuse, Vec3{1, 1, 1} * (.4f * .96f));
  expect_near(of(1).specular, {.04f, .04f, .04f});
  EXPECT_NEAR(of(1).shininess, 6, 1e-4f);
  EXPECT_EQ(of(2).reflection, (Vec3{.9f, .9f, .9f}));
  EXPECT_EQ(of(3).transmission, (Vec3{1, 1, 1}));
  EXPECT_EQ(of(3).refraction_index, 1.33f);
  EXPECT_GT(of(4).reflection.x, 0.9f);
  EXPECT_EQ(of(5).diffuse, (Vec3{.5f, .5f, .5f}));
  EXPECT_EQ(of(5).transmission, (Vec3{.5f, .5f, .5f}));
  EXPECT_EQ(of(6).diffuse, (Vec3{.7f, .7f, .7f}));
  EXPECT_EQ(scene.meshes[0].materials[7], scene.meshes[0].materials[0]) << "equal materials are one";
  EXPECT_TRUE(notes_contain(scene, "m.pbrt:10: the material type 'velvet' is not known here"));
  EXPECT_TRUE(notes_contain(scene, "m.pbrt:12: the material 'nothing' is not defined"));
}

TEST_F(Pbrt, LightsAreReadInWorldSpace) {
  const Scene scene = load_text("l.pbrt", R"(
Translate 1 0 0
LightSource "point" "rgb I" [1 2 3] "point3 from" [0 1 0] "float scale" 2
LightSource "distant" "point3 from" [0 5 0] "point3 to" [0 0 0] "rgb L" [4 4 4]
LightSource "spot" "float coneangle" 60 "float conedeltaangle" 30
LightSource "infinite" "blackbody L" [6500] "string filename" "sky.exr"
LightSource "laser"
AttributeBegin AreaLightSource "diffuse" "rgb L" [5 6 7] "bool twosided" true )" +
                                              triangle + " AttributeEnd " + triangle);
  ASSERT_EQ(scene.lights.size(), 4u);
  EXPECT_EQ(scene.lights[0].position, (Vec3{1, 1, 0}));
  EXPECT_EQ(scene.lights[0].intensity, (Vec3{2, 4, 6}));
  EXPECT_EQ(scene.lights[1].kind, LightKind::distant);
  EXPECT_EQ(scene.lights[1].direction, (Vec3{0, -1, 0}));
  EXPECT_EQ(scene.lights[2].kind, LightKind::spot);
  EXPECT_NEAR(scene.lights[2].dark_cosine, 0.5f, 1e-6f);
  EXPECT_NEAR(scene.lights[2].full_cosine, std::sqrt(0.75f), 1e-6f);
  EXPECT_EQ(scene.lights[3].kind, LightKind::sky);
  EXPECT_NEAR(scene.lights[3].intensity.y, 0.94f, 0.05f) << "6500 K is nearly white";
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(scene.materials[mesh.materials[0]].emission, (Vec3{5, 6, 7}));
  EXPECT_TRUE(scene.materials[mesh.materials[0]].emits_behind);
  EXPECT_EQ(scene.materials[mesh.materials[1]].emission, (Vec3{}));
  EXPECT_TRUE(notes_contain(scene, "l.pbrt:6: pictures of lights are not read"));
  EXPECT_TRUE(notes_contain(scene, "l.pbrt:7: the light type 'laser' is not known here"));
}

TEST_F(Pbrt, UnknownThingsAreToldOnceAndSkipped) {
  const Scene scene =
      load_text("u.pbrt", "Sampler \"sobol\" \"integer pixelsamples\" 4\nFrobnicate \"a\" [1 2] true 3\n" + triangle +
                              " \"texture alpha\" \"holes\"\nFrobnicate\nShape \"teapot\"\n" + triangle);
  EXPECT_EQ(scene.unique_triangles(), 2u);
  ASSERT_EQ(scene.notes.messages.size(), 3u);
  EXPECT_TRUE(notes_contain(scene, "u.pbrt:2: the directive 'Frobnicate' is not known here; it was skipped (1 more"));
  EXPECT_TRUE(notes_contain(scene, "u.pbrt:3: alpha"));
  EXPECT_TRUE(notes_contain(scene, "u.pbrt:5: the shape 'teapot' is not read"));
}

TEST_F(Pbrt, FacesThatReferToNothingAreSkippedAndNoted) {
  const Scene scene = load_text(
      "t.pbrt", R"(Shape "trianglemesh" "integer indices" [0 1 2 0 1 3 -1 0 1] "point P" [0 0 0 1 0 0 0 1 0])");
  EXPECT_EQ(scene.unique_triangles(), 1u);
  EXPECT_TRUE(
      notes_contain(scene, "t.pbrt:1: face 1 refers to a vertex beyond the 3 that there are; it was skipped (1 more"));
}

TEST_F(Pbrt, AMissingFileThatAppearsIsReadInSpiteOfTheCache) {
  const std::string padding = "#" + std::string(4u << 20, '#') + "\n";
  const std::string file = write("k.pbrt", padding + triangle + "Shape \"plymesh\" \"string filename\" \"late.ply\"");
  EXPECT_EQ(load(file).unique_triangles(), 1u);
  EXPECT_EQ(load(file).unique_triangles(), 1u);
  write("late.ply", triangle_ply());
  EXPECT_EQ(load(file).unique_triangles(), 2u);
}

}  // namespace
}  // namespace boxwood
