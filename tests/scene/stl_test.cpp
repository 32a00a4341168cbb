#include <fmt/format.h>

#include "temporary_folder.h"

namespace boxwood {
namespace {

const std::vector<std::array<Vec3, 3>> facets = {{square[0], square[1], square[2]}, {square[0], square[2], square[3]}};

std::string ascii() {
  std::string text = "solid test of two\n";
  for (const auto& facet : facets) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (const Vec3& p : facet) text += fmt::format("  vertex {} {} {:e}\n", p.x, p.y, p.z);
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid test of two\n";
}

std::string binary(std::string_view title, std::uint32_t promised) {
  std::string bytes(title);
  bytes.resize(80, ' ');
  put(bytes, promised);
  for (const auto& facet : facets) {
    put(bytes, Vec3{});
    for (const Vec3& p : facet) put(bytes, p);
    put(bytes, std::uint16_t{0});
  }
  return bytes;
}

using Stl = TemporaryFolder;

TEST_F(Stl, BothFormatsGiveTheSameMesh) {
  for (const std::string& bytes : {ascii(), binary("any", 2), binary("solid but binary", 2)}) {
    const Scene scene = load_text("a.STL", bytes);
    ASSERT_TRUE(scene.single_level());
    const Mesh& mesh = scene.meshes[0];
    ASSERT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}}));
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(mesh.positions[i], facets[i / 3][i % 3]);
  }
}

TEST_F(Stl, EveryTruncationIsRefusedInOneSentence) {
  for (const std::string& whole : {ascii(), binary("any", 2)}) {
    // "endsolid" may be cut short from its name on.
    const std::size_t last = whole.starts_with("solid") ? whole.rfind("endsolid") : whole.size() - 1;
    for (std::size_t size = 1; size <= last; ++size) {
      const std::string told = refusal("t.stl", std::string_view(whole).substr(0, size));
      EXPECT_TRUE(is_one_sentence(told, path("t.stl"))) << size << " of " << whole.size();
    }
  }
}

TEST_F(Stl, BrokenFilesAreExplained) {
  const std::pair<std::string, std::string> cases[] = {
      {binary("any", 3), "x.stl: ends after 2 of 3 triangles"},
      {binary("any", 0xffffffffu), "x.stl: ends after 2 of 4294967295 triangles"},
      {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n", "x.stl:4: expected a coordinate"},
      {"solid a\nfacet normal 0 0 1\nouter ring\n", "x.stl:3: expected 'loop', found 'ring'"},
      {"solid a\nbody\n", "x.stl:2: expected 'facet' or 'endsolid', found 'body'"},
      {"facets", "x.stl: 6 bytes are too few"},
  };
  for (const auto& [bytes, expected] : cases) {
    const std::string told = refusal("x.stl", bytes);
    EXPECT_NE(told.find(expected), std::string::npos) << told;
  }
}

}  // namespace
}  // namespace boxwood
