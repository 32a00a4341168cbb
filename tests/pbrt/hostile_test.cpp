#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "scene/temporary_folder.h"

namespace boxwood {
namespace {

using PbrtHostile = TemporaryFolder;

const std::string whole = R"(LookAt 1 2 3 0 0 0 0 1 0 # eye
Camera "perspective" "float fov" [40]
WorldBegin
Texture "t" "spectrum" "constant" "rgb value" [.1 .2 .3]
MakeNamedMaterial "m" "string type" "matte" "texture Kd" "t"
AttributeBegin
  Rotate 30 0 1 0
  AreaLightSource "diffuse" "rgb L" [1 1 1]
  NamedMaterial "m"
  Shape "trianglemesh" "integer indices" [0 1 2] "point P" [0 0 0 1 0 0 0 1 0] "normal N" [0 0 1 0 0 1 0 0 1]
  Shape "sphere" "float radius" 2 "float zmin" -1
AttributeEnd
ObjectBegin "o"
  Shape "disk"
ObjectEnd
ObjectInstance "o"
WorldEnd
)";

/// Empty, or one sentence that names the file and a line.
testing::AssertionResult is_told_with_its_line(const std::string& told, const std::string& file) {
  if (told.empty()) return testing::AssertionSuccess();
  if (told.find('\n') != told.npos) return testing::AssertionFailure() << "several lines: " << told;
  if (told.find(file + ":") == told.npos || told.find(": ") == told.npos) {
    return testing::AssertionFailure() << "names no line: " << told;
  }
  return testing::AssertionSuccess();
}

TEST_F(PbrtHostile, EveryTruncationIsASmallerSceneOrToldWithItsLine) {
  ASSERT_EQ(refusal("w.pbrt", whole), "");
  std::size_t refused = 0;
  for (std::size_t size = 1; size < whole.size(); ++size) {
    const std::string told = refusal("t.pbrt", whole.substr(0, size));
    ASSERT_TRUE(is_told_with_its_line(told, path("t.pbrt"))) << size;
    refused += !told.empty();
  }
  EXPECT_GT(refused, whole.size() / 2);
  EXPECT_NE(
      refusal("t.pbrt", whole.substr(0, whole.find("AttributeEnd"))).find("t.pbrt:6: what begins here never ends"),
      std::string::npos);
}

TEST_F(PbrtHostile, FlippedBytesNeverDoHarm) {
  for (std::size_t i = 0; i < whole.size(); i += 2) {
    for (const char value : {'\0', '9', '"', '[', '\xff', '-'}) {
      std::string bytes = whole;
      bytes[i] = value;
      ASSERT_TRUE(is_told_with_its_line(refusal("f.pbrt", bytes), path("f.pbrt"))) << i << " to " << int{value};
    }
  }
}

TEST_F(PbrtHostile, WrongInputIsExplained) {
  const std::string deep = [] {
    std::string text;
    for (int i = 0; i < 20'000; ++i) text += "AttributeBegin\n";
    return text;
  }();
  const std::pair<std::string, std::string> cases[] = {
      {"WorldBegin\nAttributeEnd", "x.pbrt:2: ends what never began"},
      {"AttributeBegin\nTransformBegin\nAttributeEnd", "x.pbrt:3: ends something else than what began at "},
      {"Translate 1 2", "x.pbrt:1: expected a number for Translate, found the end of the file"},
      {"Scale 1 2 up", "expected a number for Scale, found 'up'"},
      {"Transform [1 2 3]", "expected a number for Transform, found ']'"},
      {"Rotate 30 0 0 0", "Rotate needs an axis that is not zero"},
      {"LookAt 0 0 0 0 0 0 0 1 0", "LookAt needs a target away from the eye"},
      {"Scale 0 0 0\nCamera \"perspective\"", "x.pbrt:2: the camera's transform has no inverse"},
      {"Camera \"perspective\" \"float fov\" 200", "fov must lie between 0 and 180"},
      {"Shape sphere", "expected a shape type in quotes, found 'sphere'"},
      {"Shape \"sphere\" \"radius\" 1", "'radius' must be a type and a name"},
      {"Shape \"sphere\" \"float radius\" \"big\"", "expected a value of type float for 'radius', found 'big'"},
      {"Shape \"sphere\" \"float radius\" nan", "the parameter 'radius' must be finite"},
      {"Shape \"trianglemesh\" \"point P\" [0 0]", "'P' has 2 numbers, which are no whole points"},
      {"Shape \"trianglemesh\" \"point P\" [0 0 0] \"integer indices\" [0 0]", "'indices' has 2 numbers"},
      {"Shape \"trianglemesh\" \"point P\" [0 0 0] \"integer indices\" [99999999999]", "a whole number for 'indices'"},
      {"Shape \"trianglemesh\" \"point P\" [0 0 0] \"normal N\" [0 0 1 0 0 1]", "there are 2 normals for 1 points"},
      {"Shape \"plymesh\" \"string filename\" 3", "a value of type string for 'filename', found '3'"},
      {"Shape \"sphere\" \"float radius\" [1", "x.pbrt:1: expected ']', found the end of the file"},
      {"Shape \"sphere", "does not end on its line"},
      {"[ 1 2 ]", "expected a directive, found '['"},
      {"12", "expected a directive, found '12'"},
      {"ObjectEnd", "ends an object where none began"},
      {"ObjectBegin \"a\"\nObjectBegin \"b\"", "x.pbrt:2: an object begins inside an object"},
      {std::string(100'000, 'x'), "a word is longer than 1000 bytes"},
      {"\"" + std::string(100'000, 'x') + "\"", "a text is longer than 65536 bytes"},
      {deep, "x.pbrt:10001: scopes are nested more than 10000 deep"},
  };
  for (const auto& [text, expected] : cases) {
    const std::string told = refusal("x.pbrt", text);
    EXPECT_NE(told.find(expected), std::string::npos) << "'" << told << "' for " << text.substr(0, 80);
    EXPECT_TRUE(is_told_with_its_line(told, path("x.pbrt")));
  }
}

TEST_F(PbrtHostile, FilesThatIncludeThemselvesAreRefused) {
  EXPECT_NE(refusal("r.pbrt", "WorldBegin\nInclude \"r.pbrt\"\n").find("r.pbrt:2: files include files deeper than 64"),
            std::string::npos);
}

TEST_F(PbrtHostile, IncludesThatMultiplyAreRefused) {
  for (int i = 0; i < 40; ++i) {
    const std::string next = fmt::format("Include \"{0}.pbrt\"\nInclude \"{0}.pbrt\"\n", i + 1);
    write(fmt::format("{}.pbrt", i), next);
  }
  write("40.pbrt", "Identity\n");
  const std::string told = refusal("start.pbrt", "Include \"0.pbrt\"");
  EXPECT_NE(told.find("files are included more often than 16384"), std::string::npos) << told;
}

TEST_F(PbrtHostile, ObjectsThatMultiplyAreRefused) {
  std::string text = "ObjectBegin \"0\" Shape \"disk\" ObjectEnd\n";
  for (int i = 1; i < 60; ++i) {
    text += fmt::format("ObjectBegin \"{0}\" ObjectInstance \"{1}\" ObjectInstance \"{1}\" ObjectEnd\n", i, i - 1);
  }
  const std::string told = refusal("o.pbrt", text);
  EXPECT_NE(told.find("o.pbrt:25: this makes more than 2^24 placements"), std::string::npos) << told;
}

TEST_F(PbrtHostile, ObjectsOfNothingThatMultiplyAreRefusedToo) {
  std::string text = "ObjectBegin \"0\" ObjectEnd\n";
  for (int i = 1; i < 60; ++i) {
    text += fmt::format("ObjectBegin \"{0}\" ObjectInstance \"{1}\" ObjectInstance \"{1}\" ObjectEnd\n", i, i - 1);
  }
  EXPECT_NE(refusal("o.pbrt", text).find("more than 2^24 placements"), std::string::npos);
}

TEST_F(PbrtHostile, ObjectsNestedTooDeepAreRefused) {
  std::string text = "ObjectBegin \"0\" Shape \"disk\" ObjectEnd\n";
  for (int i = 1; i < 100'000; ++i) {
    text += fmt::format("ObjectBegin \"{}\" ObjectInstance \"{}\" ObjectEnd\n", i, i - 1);
  }
  const std::string told = refusal("o.pbrt", text);
  EXPECT_NE(told.find("o.pbrt:65: objects are nested more than 64 deep"), std::string::npos) << told;
}

TEST_F(PbrtHostile, AbsurdSubdivisionIsCutDownWithANote) {
  const Scene scene =
      load_text("s.pbrt", "Shape \"loopsubdiv\" \"integer levels\" 2000000000 \"integer indices\" [] \"point P\" []");
  EXPECT_EQ(scene.unique_triangles(), 0u);
  ASSERT_GE(scene.notes.messages.size(), 1u);
  EXPECT_NE(scene.notes.messages[0].find("s.pbrt:1: 2000000000 levels of subdivision"), std::string::npos);
}

TEST_F(PbrtHostile, DamagedAndInflatedArchivesAreRefused) {
  const std::string good = path("g.ply.gz");
  gzFile file = gzopen(good.c_str(), "wb9");
  const std::string zeros(1u << 20, '\0');
  for (int i = 0; i < 64; ++i) gzwrite(file, zeros.data(), static_cast<unsigned>(zeros.size()));
  gzclose(file);
  const auto told = [&](const std::string& name) {
    try {
      load(path(name));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(told("g.ply.gz").find("unpacks to more than 100 times"), std::string::npos) << told("g.ply.gz");
  std::string bytes(std::filesystem::file_size(good), '\0');
  std::ifstream(good, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  write("h.ply.gz", bytes.substr(0, 200));
  EXPECT_FALSE(told("h.ply.gz").empty());
  write("i.ply.gz", "\x1f\x8b\x08" + std::string(50, 'x'));
  EXPECT_FALSE(told("i.ply.gz").empty());
}

}  // namespace
}  // namespace boxwood
