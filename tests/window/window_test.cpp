// The viewer for real, on a virtual screen with software OpenGL: keys, mouse, pictures, and no screen at all.
#include <gtest/gtest.h>

#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#include <stb/stb_image.h>

#include <algorithm>

#include "boxwood/structure.h"
#include "render/render.h"
#include "scene/cameras.h"
#include "window_session.h"

namespace boxwood {
namespace {

namespace fs = std::filesystem;

constexpr const char* scene_name = "generate:sphereflake(depth=2)";

struct Bytes {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;
};

Bytes read_png(const fs::path& file) {
  Bytes out;
  int channels = 0;
  unsigned char* pixels = stbi_load(file.c_str(), &out.width, &out.height, &channels, 3);
  if (!pixels) return out;
  out.rgb.assign(pixels, pixels + std::size_t{3} * out.width * out.height);
  stbi_image_free(pixels);
  return out;
}

fs::path file_with(const fs::path& folder, const std::string& ending) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().string().ends_with(ending)) return entry.path();
  }
  return {};
}

std::vector<unsigned char> rendered(const Camera& camera) {
  const Scene scene = load(scene_name);
  RenderSettings settings;
  settings.camera = camera;
  settings.width = 640;
  settings.height = 480;
  return srgb_bytes(render(scene, build(scene), settings).image);
}

class Window : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::has_program("Xvfb") || !test::has_program("xdotool")) GTEST_SKIP() << "needs Xvfb and xdotool";
  }
};

TEST_F(Window, SavesThePictureThatRenderMakesAndShowsItOnTheScreen) {
  const test::WindowSession session({scene_name, "--samples", "1"});
  ASSERT_TRUE(session.press("p", "picture saved")) << session.output();
  const Bytes saved = read_png(file_with(session.folder(), ".png"));
  EXPECT_TRUE(saved.rgb == rendered(load(scene_name).cameras[0]));
  ASSERT_TRUE(session.press("k", "window saved")) << session.output();
  const Bytes shown = read_png(file_with(session.folder(), ".window.png"));
  ASSERT_EQ(shown.width, 640);
  ASSERT_EQ(shown.height, 480);
  // The right half has nothing drawn over it.
  int same = 0, coloured = 0;
  for (std::size_t y = 0; y < 480; ++y) {
    for (std::size_t x = 420; x < 640; ++x) {
      const std::size_t i = 3 * (y * 640 + x);
      same += std::equal(&shown.rgb[i], &shown.rgb[i] + 3, &saved.rgb[i]) ? 1 : 0;
      coloured += shown.rgb[i] > 40 ? 1 : 0;
    }
  }
  EXPECT_EQ(same, 220 * 480);
  EXPECT_GT(coloured, 1000);
}

TEST_F(Window, KeysAndMouseMoveTheCameraAndALoadedCameraIsTheSavedOne) {
  const test::WindowSession session({scene_name, "--samples", "1"});
  ASSERT_TRUE(session.press("o", "camera saved")) << session.output();
  const fs::path camera_file = file_with(session.folder(), ".view.json");
  const Camera first = read_cameras(camera_file)[0];
  session.tell("mousemove 500 240 mousedown 1 mousemove 560 260 sleep 0.2 mousemove 600 280 sleep 0.2 mouseup 1");
  session.tell("keydown w sleep 0.3 keyup w");
  ASSERT_TRUE(session.press("o", "camera saved"));
  const Camera moved = read_cameras(camera_file)[0];
  EXPECT_GT(length(moved.eye - first.eye), 0.05f * length(first.eye));
  EXPECT_NE(moved.direction, first.direction);
  session.tell("key x");
  ASSERT_TRUE(session.press("i", "camera loaded"));
  ASSERT_TRUE(session.press("p", "picture saved")) << session.output();
  EXPECT_TRUE(read_png(file_with(session.folder(), ".png")).rgb == rendered(moved));
}

TEST_F(Window, ComparesWalksARayAndPlaysASequence) {
  const test::WindowSession session(
      {scene_name, "generate:sphereflake(depth=1)", "--samples", "1", "-a", "sweep > slab", "-a", "binned > wide(8)"});
  ASSERT_TRUE(session.press("p", "picture saved")) << session.output();
  // The panel has a column of its own, of three tenths.
  EXPECT_EQ(read_png(file_with(session.folder(), ".second.png")).width, (640 - 192) / 3);
  const Bytes difference = read_png(file_with(session.folder(), ".difference.png"));
  EXPECT_EQ(std::ranges::count(difference.rgb, 0), static_cast<std::ptrdiff_t>(difference.rgb.size()));
  // In the second picture.
  session.tell("mousemove 418 300 click 1");
  EXPECT_TRUE(test::wait_until([&] { return session.said("node tests"); })) << session.output();
  session.tell("key u");
  ASSERT_TRUE(session.press("p", "picture saved")) << session.output();
  EXPECT_TRUE(test::wait_until([&] {
    session.press("p", "picture saved");
    return read_png(file_with(session.folder(), ".second.png")).width == 640 / 3;
  })) << "without the panel the pictures have all of the window";
  session.tell("key b key m key h key c");
  session.tell("key f");
  EXPECT_TRUE(session.press("k", "window saved")) << session.output();
}

TEST(WithoutAScreen, OneSentenceSaysSo) {
  const fs::path output = fs::temp_directory_path() / ("boxwood-no-screen-" + std::to_string(getpid()));
  test::Child viewer({BOXWOOD_VIEWER, scene_name}, output, "");
  EXPECT_EQ(viewer.result(), 1);
  const std::string text = test::text_of(output);
  fs::remove(output);
  EXPECT_NE(text.find("no display"), std::string::npos) << text;
  EXPECT_EQ(std::ranges::count(text, '\n'), 1) << text;
}

TEST_F(Window, TimesBothWaysToTheScreen) {
  const fs::path output = fs::temp_directory_path() / ("boxwood-transfer-" + std::to_string(getpid()));
  test::Child run({"xvfb-run", "-a", BOXWOOD_VIEWER, "--time-transfers", "--size", "64x64"}, output, ":0");
  const int result = run.result();
  const std::string text = test::text_of(output);
  fs::remove(output);
  EXPECT_EQ(result, 0) << text;
  EXPECT_NE(text.find("by pixel buffer"), std::string::npos) << text;
}

TEST(WithoutAScreen, BadUsageIsExitCodeTwo) {
  const fs::path output = fs::temp_directory_path() / ("boxwood-usage-" + std::to_string(getpid()));
  for (const std::vector<std::string>& words : {std::vector<std::string>{BOXWOOD_VIEWER},
                                                {BOXWOOD_VIEWER, scene_name, "-a", "sweeep > binary"},
                                                {BOXWOOD_VIEWER, scene_name, "--size", "wide"},
                                                {BOXWOOD_VIEWER, scene_name, "--integrator", "magic"}}) {
    test::Child viewer(words, output, "");
    EXPECT_EQ(viewer.result(), 2) << words.back();
    EXPECT_EQ(std::ranges::count(test::text_of(output), '\n'), 1) << test::text_of(output);
  }
  fs::remove(output);
}

}  // namespace
}  // namespace boxwood
