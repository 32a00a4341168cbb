#include <fmt/format.h>

#include <limits>

#include "temporary_folder.h"

namespace boxwood {
namespace {

const std::string_view header_rest =
    "comment made by a test\nelement vertex 4\nproperty float x\nproperty uchar red\nproperty double y\n"
    "property float z\nelement face 3\nproperty uchar flags\nproperty list uchar int vertex_indices\nend_header\n";

const std::vector<std::vector<std::int32_t>> faces = {{0, 1, 2}, {0, 1, 2, 3}, {1, 1, 2}};

std::string ascii() {
  std::string text = "ply\nformat ascii 1.0\n" + std::string(header_rest);
  for (const Vec3& p : square) text += fmt::format("{} 200 {} {}\n", p.x, p.y, p.z);
  for (const auto& face : faces) text += fmt::format("7 {} {}\n", face.size(), fmt::join(face, " "));
  return text;
}

std::string binary(bool big, const std::vector<std::vector<std::int32_t>>& corners = faces) {
  std::string bytes = fmt::format("ply\nformat binary_{}_endian 1.0\n{}", big ? "big" : "little", header_rest);
  for (const Vec3& p : square) {
    put(bytes, p.x, big);
    put(bytes, std::uint8_t{200}, big);
    put(bytes, static_cast<double>(p.y), big);
    put(bytes, p.z, big);
  }
  for (const auto& face : corners) {
    put(bytes, std::uint8_t{7}, big);
    put(bytes, static_cast<std::uint8_t>(face.size()), big);
    for (const std::int32_t corner : face) put(bytes, corner, big);
  }
  return bytes;
}

using Ply = TemporaryFolder;

TEST_F(Ply, AllThreeFormatsGiveTheSameMesh) {
  for (const std::string& bytes : {ascii(), binary(false), binary(true)}) {
    const Scene scene = load_text("a.ply", bytes);
    ASSERT_TRUE(scene.single_level());
    EXPECT_EQ(scene.meshes[0].positions, square);
    EXPECT_EQ(scene.meshes[0].triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {1, 1, 2}}));
    EXPECT_EQ(scene.notes.degenerate_triangles, 1u);
    EXPECT_EQ(scene.name, "a");
  }
}

TEST_F(Ply, EveryTruncationIsRefusedInOneSentence) {
  for (const std::string& whole : {ascii(), binary(false), binary(true)}) {
    const bool is_ascii = whole.find("ascii") != whole.npos;
    // The last digit and line end of a text may go unnoticed.
    const std::size_t last = is_ascii ? whole.size() - 3 : whole.size() - 1;
    for (std::size_t size = 1; size <= last; ++size) {
      const std::string told = refusal("t.ply", std::string_view(whole).substr(0, size));
      EXPECT_TRUE(is_one_sentence(told, path("t.ply"))) << size << " of " << whole.size();
    }
  }
}

TEST_F(Ply, FlippedBytesNeverDoHarm) {
  for (const std::string& whole : {ascii(), binary(false), binary(true)}) {
    for (std::size_t i = 0; i < whole.size(); i += 3) {
      for (const char value : {'\0', '9', '\xff'}) {
        std::string bytes = whole;
        bytes[i] = value;
        const std::string told = refusal("f.ply", bytes);
        EXPECT_TRUE(told.empty() || is_one_sentence(told, path("f.ply"))) << told;
      }
    }
  }
}

TEST_F(Ply, FacesThatReferToNothingAreSkippedAndNotedOnce) {
  const Scene scene = load_text("b.ply", binary(false, {{0, 1, 4}, {0, 1, 2}, {-1, 0, 1}}));
  EXPECT_EQ(scene.meshes[0].triangles, (std::vector<Triangle>{{0, 1, 2}}));
  ASSERT_EQ(scene.notes.messages.size(), 1u);
  EXPECT_NE(scene.notes.messages[0].find("face refers to vertex 4 of 4; the face was skipped (1 more like it)"),
            std::string::npos);
}

TEST_F(Ply, NormalsTextureAndUnknownElementsAreUnderstood) {
  const Scene scene = load_text("n.ply",
                                "ply\r\nformat ascii 1.0\r\nelement camera 1\r\nproperty list uchar float view\r\n"
                                "element vertex 3\r\nproperty float x\r\nproperty float y\r\nproperty float z\r\n"
                                "property float nx\r\nproperty float ny\r\nproperty float nz\r\nproperty float s\r\n"
                                "property float t\r\nelement face 1\r\nproperty list uchar int vertex_index\r\n"
                                "end_header\r\n2 1 2\r\n0 0 0 0 0 1 .5 0\r\n1 0 0 0 0 1 1 0\r\nnan 1e39 0 0 0 1 0 1\r\n"
                                "3 0 1 2\r\n");
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.normals, (std::vector<Vec3>(3, {0, 0, 1})));
  EXPECT_EQ(mesh.texture_coordinates[0], (std::array<float, 2>{0.5f, 0}));
  EXPECT_EQ(mesh.positions[2].y, std::numeric_limits<float>::infinity());
  EXPECT_EQ(scene.notes.non_finite_triangles, 1u);
}

TEST_F(Ply, WrongHeadersAreExplained) {
  const std::string start = "ply\nformat ascii 1.0\n";
  const std::pair<std::string, std::string> cases[] = {
      {"solid\n", "x.ply:1: does not begin with 'ply'"},
      {"ply\nformat utf 1.0\n", "x.ply:2: 'utf' is no PLY format"},
      {start + "element vertex many\n", "x.ply:3: expected 'element NAME COUNT'"},
      {start + "element vertex 1\nproperty real x\n", "x.ply:4: 'real' is no PLY type"},
      {start + "property float x\n", "x.ply:3: a property must follow"},
      {start + "elephant\n", "x.ply:3: 'elephant' is no PLY header keyword"},
      {"ply\nelement vertex 0\nend_header\n", "x.ply:3: the header does not name its format"},
      {start + "element vertex 1\nproperty float x\nend_header\n1\n", "x.ply: its vertices lack x, y or z"},
      {start + "element vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n",
       "x.ply: the header promises 4000000000 of 'vertex'"},
      {start + "element face 1\nproperty list uchar int vertex_indices\nend_header\n3 0 1 2\n",
       "x.ply: has faces before its vertices"},
      {start + "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 up\n",
       "x.ply:8: expected a number, found 'up'"},
  };
  for (const auto& [text, expected] : cases) {
    const std::string told = refusal("x.ply", text);
    EXPECT_NE(told.find(expected), std::string::npos) << "'" << told << "' for " << text;
  }
}

}  // namespace
}  // namespace boxwood
