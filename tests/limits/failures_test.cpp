// What fails around the program: memory that is refused at every allocation in turn, a disk without room, folders that
// cannot be written.
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>

#include <atomic>
#include <new>

#include "boxwood/error.h"
#include "boxwood/ray_set.h"
#include "boxwood/structure.h"
#include "saved/files.h"
#include "scene/cameras.h"
#include "support/rays.h"
#include "support/scenes.h"

namespace {

std::atomic<std::int64_t> until_failure{-1};  // allocations that still succeed; below zero: all
std::atomic<std::int64_t> asked{0}, living{0};

void* allocate(std::size_t size, std::size_t alignment) {
  ++asked;
  if (until_failure >= 0 && until_failure-- == 0) return nullptr;
  void* memory = nullptr;
  if (posix_memalign(&memory, std::max(alignment, sizeof(void*)), std::max<std::size_t>(size, 1)) != 0) return nullptr;
  ++living;
  return memory;
}

void* allocate_or_throw(std::size_t size, std::size_t alignment) {
  void* memory = allocate(size, alignment);
  if (!memory) throw std::bad_alloc();
  return memory;
}

void release(void* memory) {
  if (!memory) return;
  --living;
  free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return allocate_or_throw(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocate(size, alignof(std::max_align_t));
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { release(memory); }

namespace boxwood {
namespace {

using test::Folder;

/// Does the work again and again, with another allocation refused each time. It must end by an exception, or get by
/// without that memory, and hold nothing afterwards.
template <class Work>
void refuse_each_allocation(const std::string& what, const Work& work) {
  work();  // whatever is made once and kept
  asked = 0;
  work();
  const std::int64_t count = asked;
  ASSERT_GT(count, 0) << what;
  std::int64_t thrown = 0;
  for (std::int64_t n = 0; n < count; ++n) {
    const std::int64_t before = living;
    until_failure = n;
    try {
      work();
    } catch (const std::bad_alloc&) {
      ++thrown;
    } catch (const Error&) {
      ++thrown;
    }
    until_failure = -1;
    ASSERT_LE(living, before) << what << " kept something after allocation " << n << " failed";
  }
  EXPECT_GT(thrown, 0) << what;
}

TEST(AllocationFailure, AtEachAllocationOfABuildIsAnExceptionAndNothingIsLost) {
  const Scene scene = test::soup(24, 0.5f, 3), placed = test::instances();
  for (const char* recipe :
       {"median > binary", "binned > wide(4)", "default", "best", "compact", "sweep > slab(packet=4)", "middle > bih",
        "octree(primitives=2) > octree", "octree(primitives=2) > bit-octree(form=free)", "hlbvh > rotate > quantized",
        "binned > quantized(form=pointers, frame=parent)", "pca > oriented", "binned > wide-slab(8)",
        "foresight > wide(8) > trace(simd=off)", "exhaustive(most=5) > order(by=sato) > binary"}) {
    const Recipe parsed = Recipe::parse(recipe);
    refuse_each_allocation(recipe, [&] { build(scene, parsed, {.threads = 1}); });
  }
  const Recipe parsed = Recipe::parse("default");
  refuse_each_allocation("two levels", [&] { build(placed, parsed, {.threads = 1}); });
}

TEST(AllocationFailure, AtEachAllocationOfARecipeAQueryAndASaveIsAnException) {
  const Folder folder;
  const Scene scene = test::soup(24, 0.5f, 3);
  const Structure structure = build(scene, "default", {.threads = 1});
  const std::vector<Ray> rays = test::troubling_rays(scene, 8, 1);
  refuse_each_allocation("parse", [&] { Recipe::parse("sweep(k=4, cost=blend(sah, rdh)) > wide(4)"); });
  refuse_each_allocation("all hits", [&] { structure.all_hits(rays); });
  refuse_each_allocation("save", [&] { save(structure, folder.file("a.boxwood")); });
  save(structure, folder.file("a.boxwood"));
  refuse_each_allocation("load", [&] { load_structure(folder.file("a.boxwood")); });
  save_ray_sets(folder.file("a.rays"), std::vector<RaySet>{{"primary", Query::closest_hit, rays}});
  refuse_each_allocation("rays", [&] { load_ray_sets(folder.file("a.rays")); });
}

TEST(AllocationFailure, AtEachAllocationOfAnImportIsAnException) {
  const Folder folder;
  setenv("BOXWOOD_CACHE", "off", 1);
  const std::pair<const char*, const char*> files[] = {
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3 4\nf 9 9 9\nf 1 2\n"},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
       "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
      {"a.stl",
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
       "endsolid a\n"},
      {"a.pbrt",
       "WorldBegin\nMaterial \"matte\"\nShape \"trianglemesh\" \"point P\" [0 0 0 1 0 0 0 1 0] \"integer "
       "indices\" [0 1 2]\nWorldEnd\n"},
  };
  for (const auto& [name, text] : files) {
    test::write_bytes(folder.file(name), text);
    refuse_each_allocation(name, [&] { load(folder.file(name).string()); });
  }
}

/// While it lives files may hold so many bytes: as a full disk, writing stops in the middle.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() { setrlimit(RLIMIT_FSIZE, &before_); }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  rlimit before_{};
};

std::size_t entries(const Folder& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.file(""))) ++count;
  return count;
}

template <class Write>
void expect_refused(const std::string& what, const std::filesystem::path& file, const Write& write) {
  try {
    write();
    ADD_FAILURE() << what << " was written";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
  }
}

TEST(FullDisk, IsAnErrorThatNamesTheFileAndLeavesTheOldOne) {
  const Folder folder;
  const Scene scene = test::soup(24, 0.5f, 3);
  const Structure structure = build(scene, "default", {.threads = 1});
  const std::vector<RaySet> sets{{"primary", Query::closest_hit, test::troubling_rays(scene, 20, 1)}};
  const std::vector<Camera> cameras(10);
  const auto file = folder.file("a");
  test::write_bytes(file, "old");
  {
    const SmallDisk disk(300);
    expect_refused("a structure", file, [&] { save(structure, file); });
    expect_refused("rays", file, [&] { save_ray_sets(file, sets); });
    expect_refused("cameras", file, [&] { write_cameras(file, cameras); });
  }
  EXPECT_EQ(test::read_bytes(file), "old");
  EXPECT_EQ(entries(folder), 1u);
}

TEST(ReadOnlyFolder, IsAnErrorThatNamesTheFile) {
  const std::filesystem::path file = "/proc/boxwood-test";  // where not even root can make files
  const Structure structure = build(test::soup(4, 0.5f, 3), "default", {.threads = 1});
  expect_refused("a structure", file, [&] { save(structure, file); });
  expect_refused("cameras", file, [&] { write_cameras(file, std::vector<Camera>(1)); });
}

}  // namespace
}  // namespace boxwood
