// Textures of materials: found, read once, and never a reason to refuse a scene.
#include "scene/texture_file.h"
#include "temporary_folder.h"

namespace boxwood {
namespace {

using Textures = TemporaryFolder;

/// An uncompressed TGA image with two rows, the upper one red and green, the lower one blue and white.
std::string four_colors() {
  std::string bytes(18, '\0');
  bytes[2] = 2;               // true colour
  bytes[12] = bytes[14] = 2;  // size
  bytes[16] = 24;
  for (const char* bgr : {"\xff\x00\x00", "\xff\xff\xff", "\x00\x00\xff", "\x00\xff\x00"}) bytes.append(bgr, 3);
  return bytes;
}

const std::vector<std::uint8_t> four_pixels = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};

const std::string square_text =
    "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 3/3 4/4\n";

TEST_F(Textures, OfMtlFilesAreReadOnceWhateverTheirOptions) {
  std::filesystem::create_directories(path("maps"));
  write("maps/four colors.tga", four_colors());
  write("m.mtl",
        "newmtl a\nKd 1 1 1\nmap_Kd -s 1 1 1 -clamp on maps\\four colors.tga\n"
        "newmtl b\nmap_Kd maps/four colors.tga\nmap_Ks other.tga\n");
  const Scene scene = load_text("s.obj", square_text);
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.textures[0].width, 2u);
  EXPECT_EQ(scene.textures[0].height, 2u);
  EXPECT_EQ(scene.textures[0].pixels, four_pixels);
  for (const std::uint16_t material : scene.meshes[0].materials) EXPECT_EQ(scene.materials[material].texture, 0u);
  EXPECT_TRUE(scene.notes.messages.empty());
}

TEST_F(Textures, ThatAreMissingOrDamagedAreSaidInOneNote) {
  write("m.mtl", "newmtl a\nmap_Kd none.png\nnewmtl b\nmap_Kd bad.png\n");
  write("bad.png", "\x89PNG and no more");
  const Scene scene = load_text("s.obj", square_text);
  ASSERT_EQ(scene.notes.messages.size(), 1u);
  EXPECT_TRUE(is_one_sentence(scene.notes.messages[0], "none.png"));
  EXPECT_NE(scene.notes.messages[0].find("1 more"), std::string::npos) << scene.notes.messages[0];
  for (const Texture& texture : scene.textures) EXPECT_TRUE(texture.pixels.empty());
}

TEST_F(Textures, ComeBackFromTheCacheAndFollowTheirFiles) {
  write("t.tga", four_colors());
  write("m.mtl", "newmtl a\nmap_Kd t.tga\nnewmtl b\n");
  const std::string file = write("s.obj", square_text + std::string(std::size_t{4} << 20, '#'));
  load(file);
  const Scene again = load(file);
  EXPECT_EQ(again.textures.at(0).pixels, four_pixels);
  std::string other = four_colors();
  other[18] = '\x10';
  write("t.tga", other);
  EXPECT_EQ(load(file).textures.at(0).pixels.at(8), 0x10);
}

TEST(TextureFile, Truncated_IsRefusedInOneSentenceOrFilledUp) {
  const std::string whole = four_colors();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    try {
      const Texture texture = decode_texture(std::as_bytes(std::span(whole).first(size)), "t.tga");
      EXPECT_EQ(texture.pixels.size(), 12u) << size;
      EXPECT_GE(size, 17u);  // all of the header that matters
    } catch (const Error& error) {
      EXPECT_TRUE(is_one_sentence(error.what(), "t.tga"));
    }
  }
}

/// Two pixels, red and blue, as PNG in base 64.
const std::string two_pixels =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAADUlEQVR42mP4zwAE/wEHAAH/PX2MSQAAAABJRU5ErkJggg==";

TEST_F(Textures, WithinAGltfFileAreDecoded) {
  std::string bytes;
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}) put(bytes, p);
  for (const float uv : {0.f, 1.f, 1.f, 1.f, 0.f, 0.f}) put(bytes, uv);
  write("a.bin", bytes);
  const Scene scene = load_text("a.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
"nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
"materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 1, 1], "baseColorTexture": {"index": 0}}}],
"textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,)" +
                                              two_pixels + R"("}],
"buffers": [{"uri": "a.bin", "byteLength": 60}],
"bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
              {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}]})");
  ASSERT_EQ(scene.textures.size(), 1u) << testing::PrintToString(scene.notes.messages);
  EXPECT_EQ(scene.textures[0].pixels, (std::vector<std::uint8_t>{255, 0, 0, 0, 0, 255}));
  // glTF counts from the upper edge, Boxwood from the lower.
  EXPECT_EQ(scene.meshes[0].texture_coordinates[0], (std::array<float, 2>{0, 0}));
  EXPECT_EQ(scene.meshes[0].texture_coordinates[2], (std::array<float, 2>{0, 1}));
}

}  // namespace
}  // namespace boxwood
