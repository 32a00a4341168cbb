#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace boxwood::cli {

/// What most commands take.
struct CommonOptions {
  unsigned threads = 0;  ///< 0: as many as the machine has
  bool json = false;     ///< one JSON document on standard output and nothing else there
};

/// From where a scene is looked at.
struct ViewOptions {
  std::string camera;  ///< name; empty: the scene's first
  std::uint32_t width = 512, height = 512;
};

struct RenderOptions {
  CommonOptions common;
  ViewOptions view;
  std::string scene;
  std::string recipe = "default";
  std::string integrator = "eyelight";
  std::uint32_t spp = 1;
  std::string output = "out.png";
  bool force = false;
};

struct CompareOptions {
  CommonOptions common{.threads = 1};
  ViewOptions view;
  std::vector<std::string> scenes;
  std::vector<std::string> recipes;  ///< empty: a spread of everything there is
  std::vector<std::string> rays;     ///< kinds; empty: primary, shadow, ao, diffuse
  std::uint32_t repeats = 11;
  std::string save_rays, load_rays;  ///< files
  std::string images;                ///< folder
  bool force = false;
};

struct InspectOptions {
  CommonOptions common;
  std::string scene;
  std::string recipe = "default";
};

struct VerifyOptions {
  CommonOptions common;
  ViewOptions view;
  std::string scene;
  std::vector<std::string> recipes;  ///< empty: every registered builder and layout, walked in every way
  std::uint32_t rays = 10000;        ///< at most; brute force on a large mesh gets fewer
  std::string load_rays;
};

struct BenchOptions {
  CommonOptions common{.threads = 1};
  std::string peer;    ///< "embree", or empty for none
  bool quick = false;  ///< small scenes and few repeats
  bool huge = false;   ///< also build 28 million triangles
};

struct ListOptions {
  bool json = false;
  bool markdown = false;
};

// One function per command. Each returns the exit code, and throws Error or UsageError.

int run_render(const RenderOptions& options);
int run_compare(const CompareOptions& options);
int run_inspect(const InspectOptions& options);
int run_verify(const VerifyOptions& options);
int run_bench(const BenchOptions& options);
int run_recipes(const ListOptions& options);
int run_scenes(const ListOptions& options);

}  // namespace boxwood::cli
