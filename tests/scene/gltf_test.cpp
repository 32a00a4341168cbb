#include <fmt/format.h>

#include "temporary_folder.h"

namespace boxwood {
namespace {

/// One triangle in three places, and another mesh once, one level down.
const std::string_view document = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2, 3, 5]}],
"nodes": [{"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]}, {"mesh": 0, "scale": [2, 2, 2]},
  {"translation": [0, 0, 7], "children": [4]}, {"mesh": 1, "rotation": [0, 0, 0.70710678, 0.70710678]},
  {"camera": 0, "translation": [1, 2, 3]}],
"cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1, "aspectRatio": 2}}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]},
           {"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
"materials": [{"name": "red", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}, "emissiveFactor": [0, 0.5, 0]}],
"buffers": [{"uri": "a.bin", "byteLength": 42}],
"bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
              {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}]})";

class Gltf : public TemporaryFolder {
 protected:
  Gltf() {
    std::string bytes;
    for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}) put(bytes, p);
    for (std::uint16_t i = 0; i < 3; ++i) put(bytes, i);
    write("a.bin", bytes);
  }
};

TEST_F(Gltf, SharedMeshesStayInstancesAndSingleOnesAreBaked) {
  const Scene scene = load_text("a.gltf", document);
  ASSERT_EQ(scene.meshes.size(), 2u);
  ASSERT_EQ(scene.instances.size(), 4u);
  EXPECT_EQ(scene.unique_triangles(), 2u);
  EXPECT_EQ(scene.placed_triangles(), 4u);
  // The single one first, in world space: turned by 90 degrees and moved.
  EXPECT_EQ(scene.instances[0].mesh, 0u);
  EXPECT_EQ(scene.instances[0].object_to_world, Transform{});
  const Vec3 turned = scene.meshes[0].positions[1];
  EXPECT_NEAR(turned.x, 0, 1e-6);
  EXPECT_NEAR(turned.y, 1, 1e-6);
  EXPECT_NEAR(turned.z, 7, 1e-6);
  EXPECT_EQ(scene.instances[2].object_to_world.point({1, 0, 0}), (Vec3{6, 0, 0}));
  EXPECT_EQ(scene.instances[3].object_to_world.point({1, 0, 0}), (Vec3{2, 0, 0}));
}

TEST_F(Gltf, MaterialsAndCamerasAreKept) {
  const Scene scene = load_text("a.gltf", document);
  ASSERT_FALSE(scene.meshes[1].materials.empty());
  const Material& material = scene.materials[scene.meshes[1].materials[0]];
  EXPECT_EQ(material.name, "red");
  EXPECT_EQ(material.diffuse, (Vec3{1, 0, 0}));
  EXPECT_EQ(material.emission, (Vec3{0, 0.5f, 0}));
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.cameras[0].eye, (Vec3{1, 2, 3}));
  EXPECT_NEAR(scene.cameras[0].fov, 0.5 * 180 / 3.14159265, 1e-3);
  EXPECT_LT(scene.cameras[0].direction.z, 0);
}

TEST_F(Gltf, FlattenWritesEveryInstanceOut) {
  const Scene flat = flatten(load_text("a.gltf", document));
  EXPECT_TRUE(flat.single_level());
  EXPECT_EQ(flat.unique_triangles(), 4u);
  EXPECT_EQ(flat.meshes[0].materials.size(), 4u);
  EXPECT_EQ(flat.meshes[0].positions[7], (Vec3{6, 0, 0}));
}

TEST_F(Gltf, EveryTruncationIsRefusedInOneSentence) {
  for (std::size_t size = 1; size + 1 < document.size(); size += 7) {
    EXPECT_TRUE(is_one_sentence(refusal("t.gltf", document.substr(0, size)), path("t.gltf"))) << size;
  }
}

TEST_F(Gltf, AMissingBufferIsRefused) {
  std::filesystem::remove(path("a.bin"));
  EXPECT_TRUE(is_one_sentence(refusal("b.gltf", document), path("b.gltf")));
}

TEST_F(Gltf, GarbageInABinaryFileIsRefused) {
  std::string bytes = "glTF";
  put(bytes, 2u);
  put(bytes, 1000u);
  for (std::size_t size = 1; size <= bytes.size(); ++size) {
    EXPECT_TRUE(is_one_sentence(refusal("g.glb", bytes.substr(0, size)), path("g.glb"))) << size;
  }
}

TEST_F(Gltf, OtherFormatsAreReadToo) {
  const Scene scene = load_text("o.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n4 0 1 2 3\n");
  EXPECT_EQ(scene.unique_triangles(), 2u);
  EXPECT_EQ(scene.bounds().upper, (Vec3{1, 1, 0.5f}));
}

}  // namespace
}  // namespace boxwood
