#include "temporary_folder.h"

namespace boxwood {
namespace {

using Load = TemporaryFolder;

std::string told(const std::string& path) {
  try {
    load(path);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST_F(Load, WhatCannotBeReadIsExplained) {
  EXPECT_NE(told(path("gone.ply")).find("gone.ply: there is no such file"), std::string::npos);
  EXPECT_NE(told(path("")).find("is a folder"), std::string::npos);
  EXPECT_NE(told(write("a.xyzzy", "1")).find("'.xyzzy' is no mesh format known here"), std::string::npos);
  EXPECT_NE(told(write("noextension", "1")).find("'' is no mesh format"), std::string::npos);
  for (const std::string name : {"e.ply", "e.obj", "e.stl", "e.gltf", "e.off"}) {
    EXPECT_NE(told(write(name, "")).find(name + ": is empty"), std::string::npos);
  }
}

TEST_F(Load, SidecarCamerasComeFirstAndTheFramingOneLast) {
  write("s.cameras.json",
        R"({"cameras": [{"name": "door", "eye": [1, 2, 3], "direction": [0, 0, -2], "up": [0, 1, 0], "fov": 50}]})");
  const Scene scene = load_text("s.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.cameras[0].name, "door");
  EXPECT_EQ(scene.cameras[1].name, "auto");
}

TEST_F(Load, SidecarBesideTheFolderServesWhenThereIsNoneBesideTheFile) {
  std::filesystem::create_directories(path("hall"));
  write("hall.cameras.json",
        R"({"cameras": [{"name": "gate", "eye": [1, 2, 3], "direction": [0, 0, -2], "up": [0, 1, 0], "fov": 50}]})");
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
  EXPECT_EQ(load_text("hall/s.obj", mesh).cameras.front().name, "gate");
  write("hall/s.cameras.json",
        R"({"cameras": [{"name": "door", "eye": [1, 2, 3], "direction": [0, 0, -2], "up": [0, 1, 0], "fov": 50}]})");
  EXPECT_EQ(load_text("hall/s.obj", mesh).cameras.front().name, "door");
}

TEST_F(Load, ABrokenSidecarIsNamed) {
  write("s.cameras.json", "{");
  EXPECT_TRUE(is_one_sentence(refusal("s.obj", "v 0 0 0\n"), path("s.cameras.json")));
}

}  // namespace
}  // namespace boxwood
