#include "fuzz/targets.h"

#include <stdlib.h>
#include <unistd.h>

#include <cstring>

#include "fuzz/support.h"

namespace boxwood::fuzz {
namespace {

constexpr Target all[] = {
    {"ply", read_ply_file},           {"obj", read_obj_file},
    {"mtl", read_mtl_file},           {"stl", read_stl_file},
    {"pbrt", read_pbrt_file},         {"cache", read_cache_entry},
    {"cameras", read_camera_sidecar}, {"rays", read_ray_sets},
    {"saved", read_saved_file},       {"patched", read_patched_structure},
    {"recipe", parse_a_recipe},       {"study", parse_a_study},
    {"geometry", trace_geometry},
};

class ScratchFolder {
 public:
  ScratchFolder() : path_(std::filesystem::temp_directory_path() / ("boxwood-fuzz-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
    setenv("BOXWOOD_CACHE", (path_ / "cache").c_str(), 1);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace

const std::filesystem::path& scratch() {
  static const ScratchFolder folder;
  return folder.path();
}

std::span<const Target> targets() { return all; }

const Target* find_target(const char* name) {
  for (const Target& target : all) {
    if (std::strcmp(target.name, name) == 0) return &target;
  }
  return nullptr;
}

}  // namespace boxwood::fuzz
