// All hits, the first k, and filters: on every registered layout what brute force says, to the bit.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "boxwood/structure.h"
#include "support/differential.h"
#include "support/layout_recipes.h"
#include "support/rays.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

struct Case {
  test::NamedScene named;
  std::vector<Ray> rays;
  std::vector<std::vector<Hit>> hits;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> out;
    for (test::NamedScene& named : test::troubled_scenes()) {
      std::vector<Ray> rays = test::troubling_rays(named.scene, 60, 90 + out.size());
      const BruteForce truth(named.scene);
      std::vector<std::vector<Hit>> hits;
      for (const Ray& ray : rays) hits.push_back(truth.all_hits(ray));
      out.push_back({std::move(named), std::move(rays), std::move(hits)});
    }
    return out;
  }();
  return all;
}

/// Every layout, over a tree that suits it; `spatial` has triangles in several leaves.
std::vector<std::string> recipes() {
  std::vector<std::string> out = {
      "spatial > wide(4)", "spatial > wide(16)",           "spatial > wide(5)",
      "spatial > bih",     "octree > octree(mailbox=off)", "binned > binary > trace(cull=off)"};
  for (const std::string& each : test::recipe_of_every_layout("spatial")) out.push_back(each);
  return out;
}

bool same(std::span<const Hit> a, std::span<const Hit> b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!test::same_bits(a[i], b[i])) return false;
  }
  return true;
}

class HitQueries : public testing::TestWithParam<std::string> {};

TEST_P(HitQueries, AllHitsAreThoseOfBruteForceInOrderEachOnce) {
  for (const Case& c : cases()) {
    const Structure structure = build(c.named.scene, GetParam());
    const HitLists lists = structure.all_hits(c.rays);
    ASSERT_EQ(lists.size(), c.rays.size());
    for (std::size_t i = 0; i < c.rays.size(); ++i) {
      ASSERT_TRUE(same(lists[i], c.hits[i]))
          << c.named.name << ", ray " << i << ": " << lists[i].size() << " hits of " << c.hits[i].size();
    }
    EXPECT_TRUE(same(structure.all_hits(c.rays[0]), c.hits[0]));
  }
}

TEST_P(HitQueries, FirstHitsAreTheFrontOfAllHits) {
  for (const Case& c : cases()) {
    const Structure structure = build(c.named.scene, GetParam());
    for (const std::size_t k : {1u, 3u, 20u}) {
      std::vector<Hit> batch(k * c.rays.size());
      structure.first_hits(c.rays, k, batch);
      for (std::size_t i = 0; i < c.rays.size(); ++i) {
        std::vector<Hit> expected = c.hits[i], found(k);
        expected.resize(k);
        EXPECT_EQ(structure.first_hits(c.rays[i], found), std::min(k, c.hits[i].size()));
        ASSERT_TRUE(same(found, expected)) << c.named.name << ", ray " << i;
        ASSERT_TRUE(same(std::span(batch).subspan(i * k, k), expected)) << c.named.name << ", ray " << i;
      }
    }
  }
}

/// Takes one triangle in eleven, so that dozens are asked for.
constexpr auto takes = [](const Hit& hit) { return hit.primitive % 11 == 3; };

TEST_P(HitQueries, FiltersAreAskedAboutEveryHitInOrderUntilTheyTakeOne) {
  for (const Case& c : cases()) {
    const Structure structure = build(c.named.scene, GetParam());
    std::vector<std::vector<Hit>> asked(c.rays.size());
    std::vector<Hit> hits(c.rays.size());
    std::vector<std::uint8_t> blocked(c.rays.size());
    structure.closest_hits(c.rays, hits, [&](std::size_t ray, const Hit& hit) {
      asked[ray].push_back(hit);
      return takes(hit);
    });
    structure.any_hits(c.rays, blocked, takes);
    for (std::size_t i = 0; i < c.rays.size(); ++i) {
      std::vector<Hit> expected;
      Hit taken;
      for (std::size_t n = 0; n < c.hits[i].size() && !taken.valid(); ++n) {
        expected.push_back(c.hits[i][n]);
        if (takes(expected.back())) taken = expected.back();
      }
      ASSERT_TRUE(same(asked[i], expected)) << c.named.name << ", ray " << i;
      ASSERT_TRUE(test::same_bits(hits[i], taken)) << c.named.name << ", ray " << i;
      ASSERT_EQ(blocked[i] != 0, taken.valid());
      ASSERT_TRUE(test::same_bits(structure.closest_hit(c.rays[i], takes), taken));
      ASSERT_EQ(structure.any_hit(c.rays[i], takes), taken.valid());
    }
  }
}

std::string name_of(const testing::TestParamInfo<std::string>& parameters) {
  std::string name = std::to_string(parameters.index);
  for (const char c : parameters.param) name += std::isalnum(static_cast<unsigned char>(c)) ? std::string(1, c) : "";
  return name;
}

INSTANTIATE_TEST_SUITE_P(Registered, HitQueries, testing::ValuesIn(recipes()), name_of);

TEST(HitQueriesOf, CasesThatProveSomething_HaveTiesAndManyHits) {
  std::size_t ties = 0, longest = 0;
  for (const Case& c : cases()) {
    for (const std::vector<Hit>& hits : c.hits) {
      longest = std::max(longest, hits.size());
      for (std::size_t n = 1; n < hits.size(); ++n) ties += hits[n].t == hits[n - 1].t ? 1 : 0;
    }
  }
  EXPECT_GT(ties, 100u);
  EXPECT_GT(longest, 40u);
}

TEST(HitQueriesOf, InvalidRays_FindNothing) {
  const Structure structure = build(test::soup(200, 0.5f, 4));
  for (const Ray& ray : test::invalid_rays({0, 0, 0}, {1, 0, 0})) {
    Hit hits[2];
    EXPECT_TRUE(structure.all_hits(ray).empty());
    EXPECT_EQ(structure.first_hits(ray, hits), 0u);
    EXPECT_FALSE(structure.closest_hit(ray, [](const Hit&) { return true; }).valid());
  }
}

TEST(HitQueriesOf, WrongLengthsAndPeers_AreRefused) {
  const Scene scene = test::soup(20, 0.5f, 4);
  const Structure structure = build(scene);
  const std::vector<Ray> rays(3);
  std::vector<Hit> hits(7);
  EXPECT_THROW(structure.first_hits(rays, 2, hits), UsageError);
  EXPECT_THROW(structure.first_hits(rays, 0, hits), UsageError);
  EXPECT_THROW(structure.closest_hits(rays, hits, takes), UsageError);
  structure.first_hits(rays, 0, {});
  EXPECT_EQ(structure.first_hits(rays[0], {}), 0u);
#ifdef BOXWOOD_EMBREE
  const Structure peer = build(scene, "embree");
  EXPECT_THROW(peer.all_hits(rays), UsageError);
  EXPECT_THROW(peer.closest_hit(rays[0], takes), UsageError);
  EXPECT_THROW(peer.first_hits(rays, 0, {}), UsageError);
#endif
}

TEST(HitQueriesOf, AFilterThatThrows_EndsTheQuery) {
  const Structure structure = build(test::coincident(5));
  int asked = 0;
  const auto refuse = [&](const Hit&) -> bool {
    if (++asked == 3) throw Error("stop");
    return false;
  };
  EXPECT_THROW(structure.closest_hit({{0.2f, 0.4f, 5}, 0, {0, 0, -1}}, refuse), Error);
  EXPECT_EQ(asked, 3);
}

}  // namespace
}  // namespace boxwood
