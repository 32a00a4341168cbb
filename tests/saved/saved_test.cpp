// Saved structures come back as they were, and damaged files do not come back at all.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "layout/layout.h"
#include "layout/saved_level.h"
#include "saved/files.h"
#include "support/rays.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

using namespace test;

constexpr const char* saved_recipes[] = {
    "median > binary",
    "binned > binary > trace(order=axis, mode=recursive, cull=off)",
    "binned > wide(4)",
    "binned > wide(8)",
    "binned > wide(16)",
    "median(k=3, leaf=9) > wide(5)",
    "binned > wide(8) > trace(simd=off)",
    "spatial > wide(8)",
    "binned > collapse(8) > compressed(8)",
    "binned > collapse(16) > compressed(16)",
};

struct Answers {
  std::vector<Hit> hits;
  std::vector<std::uint8_t> blocked;
  std::vector<RayCounters> counters;

  Answers(const Structure& structure, std::span<const Ray> rays)
      : hits(rays.size()), blocked(rays.size()), counters(rays.size()) {
    structure.closest_hits_counted(rays, hits, counters);
    structure.closest_hits(rays, hits);
    structure.any_hits(rays, blocked);
  }
  bool operator==(const Answers& other) const {
    const auto same = [](const auto& a, const auto& b) {
      return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
    };
    return same(hits, other.hits) && same(blocked, other.blocked) && same(counters, other.counters);
  }
};

TEST(SavedStructure, AnswersAsBeforeOnEveryTroubledScene) {
  const Folder folder;
  for (const NamedScene& named : troubled_scenes()) {
    const std::vector<Ray> rays = troubling_rays(named.scene, 60, 5);
    for (const char* recipe : saved_recipes) {
      SCOPED_TRACE(named.name + ", " + recipe);
      const Structure built = build(named.scene, recipe);
      save(built, folder.file("a.boxwood"));
      for (const Verification verification : {Verification::full, Verification::header}) {
        const Structure loaded = load_structure(folder.file("a.boxwood"), {verification});
        EXPECT_TRUE(Answers(loaded, rays) == Answers(built, rays));
        EXPECT_EQ(loaded.recipe().text(), built.recipe().text());
        EXPECT_EQ(loaded.report().bytes, built.report().bytes);
        EXPECT_EQ(loaded.report().primitives, built.report().primitives);
        EXPECT_EQ(loaded.report().facts.size(), built.report().facts.size());
        EXPECT_NO_THROW(check_fits(loaded, named.scene));
      }
    }
  }
}

TEST(SavedStructure, OutlivesItsFileAndCanBeSavedAgain) {
  const Folder folder;
  const Scene scene = test::instances();
  const std::vector<Ray> rays = troubling_rays(scene, 60, 5);
  const Structure built = build(scene, "binned > wide(8)");
  save(built, folder.file("a.boxwood"));
  const Structure loaded = load_structure(folder.file("a.boxwood"));
  save(loaded, folder.file("b.boxwood"));
  EXPECT_EQ(read_bytes(folder.file("a.boxwood")), read_bytes(folder.file("b.boxwood")));
  save(loaded, folder.file("a.boxwood"));
  std::filesystem::remove(folder.file("a.boxwood"));
  EXPECT_TRUE(Answers(loaded, rays) == Answers(built, rays));
}

TEST(SavedStructure, OfACompressedTreeBringsItsMeshAlong) {
  const Folder folder;
  const std::vector<Ray> rays = troubling_rays(soup(50, 0.5f, 1), 60, 5);
  std::vector<Hit> expected(rays.size()), hits(rays.size());
  {
    const Scene scene = soup(50, 0.5f, 1);
    const Structure built = build(scene, "binned > collapse(8) > compressed(8)");
    built.closest_hits(rays, expected);
    save(built, folder.file("a.boxwood"));
  }
  load_structure(folder.file("a.boxwood")).closest_hits(rays, hits);
  EXPECT_EQ(std::memcmp(hits.data(), expected.data(), hits.size() * sizeof(Hit)), 0);
}

TEST(SavedStructure, HasTheDocumentedBytes) {
  const Folder folder;
  save(build(soup(3, 0.5f, 1), "median(leaf=4) > binary"), folder.file("a.boxwood"));
  const std::string bytes = read_bytes(folder.file("a.boxwood"));
  EXPECT_EQ(bytes.substr(0, 16), std::string("BOXWTREE\1\0\0\0\1\0\0\0", 16));
  const auto word = [&](std::size_t at) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  EXPECT_EQ(word(16), bytes.size());
  EXPECT_EQ(word(24), 5u);  // recipe, report, facts, nodes, leaves
  const std::uint64_t sizes[] = {std::string("median(leaf=4) > binary").size(), 48, 128, 32, 3 * 40};
  std::uint64_t offset = 64 + 5 * 32 + 32;
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(word(64 + 32 * i), i + 1);
    EXPECT_EQ(word(64 + 32 * i + 8), offset);
    EXPECT_EQ(word(64 + 32 * i + 16), sizes[i]);
    offset += (sizes[i] + 63) / 64 * 64;
  }
  EXPECT_EQ(offset, bytes.size());
}

TEST(SavedStructure, OtherLayoutsAreRefusedByName) {
  const Folder folder;
  const Scene scene = soup(20, 0.5f, 1);
  for (const char* recipe : {"binned > slab", "octree > octree"}) {
    try {
      save(build(scene, recipe), folder.file("a.boxwood"));
      FAIL() << recipe;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find("cannot be saved"), std::string::npos);
    }
    EXPECT_FALSE(std::filesystem::exists(folder.file("a.boxwood")));
  }
}

TEST(SavedStructure, OfOpenedInstancesFitsItsScene) {
  const Folder folder;
  const Scene scene = load("generate:instances(count=30, detail=16, spacing=0.5)");
  const std::vector<Ray> rays = troubling_rays(scene, 60, 5);
  for (const char* layout : {"wide(8)", "collapse(8) > compressed(8)"}) {
    const std::string head = "binned > rebraid(references=8) > ";
    const Structure built = build(scene, head + layout);
    save(built, folder.file("opened.boxwood"));
    const Structure loaded = load_structure(folder.file("opened.boxwood"));
    EXPECT_TRUE(Answers(loaded, rays) == Answers(built, rays)) << layout;
    EXPECT_NO_THROW(check_fits(loaded, scene)) << layout;
    EXPECT_THROW(check_fits(loaded, test::instances()), Error) << layout;
    EXPECT_GT(built.layout()->saved()->bottoms.size(), scene.meshes.size()) << layout;
  }
}

TEST(SavedStructure, OfAnotherSceneIsToldApart) {
  const Folder folder;
  const Scene scene = soup(20, 0.5f, 1);
  save(build(scene, "binned > wide(8)"), folder.file("one.boxwood"));
  const Structure one = load_structure(folder.file("one.boxwood"));
  EXPECT_THROW(check_fits(one, soup(21, 0.5f, 1)), Error);
  EXPECT_THROW(check_fits(one, test::instances()), Error);
  save(build(test::instances(), "binned > wide(8)"), folder.file("two.boxwood"));
  EXPECT_THROW(check_fits(load_structure(folder.file("two.boxwood")), scene), Error);
  // As many triangles in all, but not in the mesh that each instance places.
  Scene few_first = soup(10, 0.5f, 1), many_first = soup(20, 0.5f, 2);
  few_first.meshes.push_back(many_first.meshes[0]);
  many_first.meshes.push_back(few_first.meshes[0]);
  for (Scene* each : {&few_first, &many_first}) each->instances.push_back({1, Transform::translate({3, 0, 0})});
  save(build(few_first, "binned > wide(8)"), folder.file("three.boxwood"));
  const Structure three = load_structure(folder.file("three.boxwood"));
  EXPECT_NO_THROW(check_fits(three, few_first));
  EXPECT_THROW(check_fits(three, many_first), Error);
}

TEST(SavedStructure, MissingFilesFoldersAndOtherFilesAreRefusedByName) {
  const Folder folder;
  EXPECT_NE(refusal(folder.file("missing.boxwood")).find("missing.boxwood': No such file"), std::string::npos);
  EXPECT_NE(refusal(folder.file(".")).find("Is a directory"), std::string::npos);
  write_bytes(folder.file("empty"), "");
  EXPECT_NE(refusal(folder.file("empty")).find("ends within its header"), std::string::npos);
  write_bytes(folder.file("text"), std::string(200, 'x'));
  EXPECT_NE(refusal(folder.file("text")).find("does not begin with BOXWTREE"), std::string::npos);
}

}  // namespace
}  // namespace boxwood
