#include "scene/mesh_cache.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "scene/generators.h"
#include "temporary_folder.h"

namespace boxwood {
namespace {

Scene rich_scene() {
  Scene scene = generate("instances(count=3, detail=3)");
  scene.meshes[0].name = "knot";
  scene.materials = {{.name = "red"}, {.name = "glass"}};
  scene.materials[1].refraction_index = 1.5f;
  scene.meshes[0].materials.assign(scene.meshes[0].triangles.size(), 1);
  scene.meshes[0].normals.assign(scene.meshes[0].positions.size(), {0, 1, 0});
  scene.meshes[0].texture_coordinates.assign(scene.meshes[0].positions.size(), {0.5f, 1});
  scene.cameras = {{"eye", {1, 2, 3}, {0, 0, 1}, {0, 1, 0}, 33}};
  scene.lights = {{{1, 1, 1}, {2, 2, 2}}};
  scene.notes = {4, 5, {"one", "two"}};
  return scene;
}

void expect_equal(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.name, b.name);
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t i = 0; i < a.meshes.size(); ++i) {
    EXPECT_EQ(a.meshes[i].name, b.meshes[i].name);
    EXPECT_EQ(a.meshes[i].positions, b.meshes[i].positions);
    EXPECT_EQ(a.meshes[i].triangles, b.meshes[i].triangles);
    EXPECT_EQ(a.meshes[i].materials, b.meshes[i].materials);
    EXPECT_EQ(a.meshes[i].normals, b.meshes[i].normals);
    EXPECT_EQ(a.meshes[i].texture_coordinates, b.meshes[i].texture_coordinates);
  }
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].mesh, b.instances[i].mesh);
    EXPECT_EQ(a.instances[i].object_to_world, b.instances[i].object_to_world);
  }
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i) {
    EXPECT_EQ(a.materials[i].name, b.materials[i].name);
    EXPECT_EQ(a.materials[i].refraction_index, b.materials[i].refraction_index);
  }
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (std::size_t i = 0; i < a.cameras.size(); ++i) {
    EXPECT_EQ(a.cameras[i].name, b.cameras[i].name);
    EXPECT_EQ(a.cameras[i].fov, b.cameras[i].fov);
  }
  EXPECT_EQ(a.lights.size(), b.lights.size());
  EXPECT_EQ(a.notes.degenerate_triangles, b.notes.degenerate_triangles);
  EXPECT_EQ(a.notes.non_finite_triangles, b.notes.non_finite_triangles);
  EXPECT_EQ(a.notes.messages, b.notes.messages);
}

class MeshCache : public TemporaryFolder {
 protected:
  std::string entry_bytes() const {
    std::ifstream in(cache_entry(source_), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void replace_entry(std::string_view bytes) const {
    std::ofstream(cache_entry(source_), std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  void keep(const Scene& scene) const {
    const std::filesystem::path sources[] = {source_, second_};
    write_cached(scene, sources);
  }
  std::string source_ = write("a.obj", "source"), second_ = write("a.mtl", "materials");
};

TEST_F(MeshCache, GivesBackWhatWasKept) {
  EXPECT_FALSE(read_cached(source_));
  keep(rich_scene());
  const std::optional<Scene> found = read_cached(source_);
  ASSERT_TRUE(found);
  expect_equal(*found, rich_scene());
}

TEST_F(MeshCache, AChangedSourceIsImportedAgain) {
  keep(rich_scene());
  write("a.mtl", "other materials");
  EXPECT_FALSE(read_cached(source_));
  keep(rich_scene());
  EXPECT_TRUE(read_cached(source_));
  std::filesystem::last_write_time(source_, std::filesystem::last_write_time(source_) + std::chrono::seconds(1));
  EXPECT_FALSE(read_cached(source_));
  std::filesystem::remove(second_);
  EXPECT_FALSE(read_cached(source_));
}

TEST_F(MeshCache, DamagedEntriesAreIgnored) {
  keep(rich_scene());
  const std::string whole = entry_bytes();
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    replace_entry(whole.substr(0, size));
    ASSERT_FALSE(read_cached(source_)) << "truncated to " << size;
  }
  for (std::size_t i = 0; i < whole.size(); i += 31) {
    std::string bytes = whole;
    bytes[i] = static_cast<char>(bytes[i] ^ 0x55);
    replace_entry(bytes);
    ASSERT_FALSE(read_cached(source_)) << "byte " << i;
  }
  replace_entry(whole + "x");
  EXPECT_FALSE(read_cached(source_));
  replace_entry(whole);
  EXPECT_TRUE(read_cached(source_));
}

TEST_F(MeshCache, CanBeTurnedOff) {
  setenv("BOXWOOD_CACHE", "off", 1);
  keep(rich_scene());
  EXPECT_TRUE(cache_entry(source_).empty());
  EXPECT_FALSE(read_cached(source_));
}

TEST_F(MeshCache, AnUnwritablePlaceIsNoError) {
  setenv("BOXWOOD_CACHE", (source_ + "/below/a/file").c_str(), 1);
  EXPECT_NO_THROW(keep(rich_scene()));
  EXPECT_FALSE(read_cached(source_));
}

TEST_F(MeshCache, LoadingALargeFileTwiceGivesTheSameScene) {
  std::string text;
  for (std::uint32_t i = 0; i < 3000; ++i) text += fmt::format("v {} {} {}\n", i, i % 7, i % 11);
  for (std::uint32_t i = 3; i <= 3000; ++i) text += fmt::format("f {} {} {}\n", i - 2, i - 1, i);
  text += "# " + std::string(smallest_cached_file, '#') + "\n";
  const std::string file = write("large.obj", text);
  const Scene first = load(file);
  ASSERT_TRUE(std::filesystem::exists(cache_entry(file)));
  const Scene second = load(file);
  expect_equal(first, second);
  EXPECT_EQ(second.meshes[0].triangles.size(), 2998u);
}

}  // namespace
}  // namespace boxwood
