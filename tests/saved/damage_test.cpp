// What happens to a saved structure whose bytes are not those that were written.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <string>

#include "layout/compressed/packed_leaf.h"
#include "layout/compressed/quantized_node.h"
#include "layout/saved_level.h"
#include "layout/simd/wide_node.h"
#include "math/random.h"
#include "saved/files.h"
#include "saved/section_file.h"
#include "support/rays.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

using namespace test;

struct Case {
  std::string name;
  Scene scene;
  std::string recipe;
};

std::vector<Case> cases() {
  return {{"binary", soup(12, 0.5f, 1), "median > binary"},
          {"scalar", soup(12, 0.5f, 2), "binned > wide(4) > trace(simd=off)"},
          {"simd4", soup(20, 0.5f, 3), "binned > wide(4)"},
          {"simd8", soup(30, 0.5f, 4), "median(leaf=9) > wide(8)"},
          {"simd16", soup(20, 0.5f, 5), "binned > wide(16)"},
          {"compressed8", soup(30, 0.5f, 6), "median(leaf=3) > collapse(8) > compressed(8)"},
          {"compressed16", soup(20, 0.5f, 7), "binned > collapse(16) > compressed(16)"},
          {"placed", test::instances(), "binned > wide(8)"}};
}

/// A triangle that is placed by a transform: the smallest structure of two levels.
Scene placed_once() {
  Scene scene = soup(1, 0.5f, 6);
  scene.instances[0].object_to_world = Transform::translate({1, 2, 3});
  return scene;
}

TEST(DamagedStructure, CutAnywhereIsRefusedEvenUnverified) {
  const Folder folder;
  for (const Case& c : cases()) {
    save(build(c.scene, c.recipe), folder.file("good"));
    const std::string bytes = read_bytes(folder.file("good"));
    // Every length there is, for the smallest; a stride that meets every offset within a cache line for others.
    write_bytes(folder.file("cut"), bytes);
    for (std::size_t size = bytes.size(); size-- > 0;
         size -= bytes.size() < 1500 ? 0 : std::min<std::size_t>(size, 12)) {
      std::filesystem::resize_file(folder.file("cut"), size);
      ASSERT_NE(refusal(folder.file("cut"), Verification::header), "") << c.name << " at " << size;
    }
    write_bytes(folder.file("long"), bytes + std::string(64, '\0'));
    EXPECT_NE(refusal(folder.file("long"), Verification::header), "");
  }
}

TEST(DamagedStructure, AFlippedBitInAnyByteIsRefused) {
  const Folder folder;
  const std::vector<Case> small = {{"scalar", soup(2, 0.5f, 1), "median > binary"},
                                   {"simd", soup(2, 0.5f, 4), "median > wide(4)"},
                                   {"placed", placed_once(), "median > wide(4)"}};
  for (const Case& c : small) {
    save(build(c.scene, c.recipe), folder.file("bad"));
    const std::string bytes = read_bytes(folder.file("bad"));
    std::fstream file(folder.file("bad"), std::ios::in | std::ios::out | std::ios::binary);
    const auto set = [&](std::size_t byte, char value) {
      file.seekp(static_cast<std::streamoff>(byte)).put(value).flush();
    };
    for (std::size_t byte = 0; byte < bytes.size(); ++byte) {
      set(byte, static_cast<char>(bytes[byte] ^ (1 << (byte % 8))));
      const std::string why = refusal(folder.file("bad"));
      ASSERT_NE(why, "") << c.name << ", byte " << byte;
      ASSERT_EQ(why.find('\n'), std::string::npos) << why;
      set(byte, bytes[byte]);
    }
    EXPECT_EQ(refusal(folder.file("bad")), "");
  }
}

/// The sections of a file with one of them changed, under checksums that are right.
void rewrite(const std::filesystem::path& from, const std::filesystem::path& to, std::size_t changed,
             const std::string& bytes, std::size_t levels) {
  SectionFile file(from, true);
  std::vector<Section> sections;
  for (std::size_t i = 0; i < 2 + 3 * levels; ++i) {
    const auto kind = static_cast<SectionKind>(i < 2 ? i + 1 : 3 + (i - 2) % 3);
    sections.push_back({kind, file.next(kind)});
  }
  sections[changed].bytes = std::as_bytes(std::span(bytes));
  write_sections(to, sections);
}

std::string section_bytes(const std::filesystem::path& from, std::size_t number) {
  SectionFile file(from, true);
  std::span<const std::byte> bytes;
  for (std::size_t i = 0; i <= number; ++i)
    bytes = file.next(static_cast<SectionKind>(i < 2 ? i + 1 : 3 + (i - 2) % 3));
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(DamagedStructure, WrongNodesUnderRightChecksumsAreRefusedOrTracedWithinBounds) {
  const Folder folder;
  std::uint64_t seed = 0;
  std::size_t refused = 0, traced = 0;
  for (const Case& c : cases()) {
    const std::vector<Ray> rays = troubling_rays(c.scene, 10, 3);
    const Structure built = build(c.scene, c.recipe);
    save(built, folder.file("good"));
    const std::size_t levels = c.scene.single_level() ? 1 : c.scene.meshes.size() + 1;
    for (std::size_t section = 2; section < 2 + 3 * levels; ++section) {
      const std::string good = section_bytes(folder.file("good"), section);
      for (int n = 0; n < 30 && !good.empty(); ++n) {
        Random random(77, ++seed);
        std::string bad = good;
        const std::size_t word = random.below(static_cast<std::uint32_t>(bad.size() / 4)) * 4;
        constexpr std::uint32_t values[] = {0, 1, 2, 3, 5, 64, 0x7f800000, 0x80000000, 0xffffffff};
        std::uint32_t value = values[random.below(9)];
        if (n % 2 == 0) {  // a near miss
          std::memcpy(&value, bad.data() + word, 4);
          value ^= 1u << random.below(32);
        }
        std::memcpy(bad.data() + word, &value, 4);
        rewrite(folder.file("good"), folder.file("bad"), section, bad, levels);
        if (!refusal(folder.file("bad")).empty()) {
          ++refused;
          continue;
        }
        const Structure loaded = load_structure(folder.file("bad"));
        std::vector<Hit> hits(rays.size());
        loaded.closest_hits(rays, hits);
        for (const Hit& hit : hits) {
          ASSERT_TRUE(!hit.valid() || hit.instance < c.scene.instances.size());
        }
        for (const Ray& ray : rays) loaded.any_hit(ray);
        ++traced;
      }
    }
  }
  EXPECT_GT(refused, 100u);
  EXPECT_GT(traced, 100u);
}

std::string with_word(std::string bytes, std::size_t at, std::uint32_t word) {
  std::memcpy(bytes.data() + at, &word, sizeof word);
  return bytes;
}

TEST(DamagedStructure, NodesInACircleAndWalksWithoutRoomAreRefused) {
  struct Root {
    const char* recipe;
    std::size_t children;     // where the first child of the root stands
    std::uint32_t reference;  // the root's own
  };
  const Root roots[] = {
      {"binned > wide(16)", 64 + offsetof(WideNode<16>, children), 4},
      {"binned > collapse(16) > compressed(16)", sizeof(QuantizedNode16) + offsetof(QuantizedNode16, children), 96}};
  const Folder folder;
  for (const Root& root : roots) {
    save(build(soup(60, 0.5f, 5), root.recipe), folder.file("good"));
    const std::string facts = section_bytes(folder.file("good"), 2), nodes = section_bytes(folder.file("good"), 3);
    rewrite(folder.file("good"), folder.file("bad"), 3, with_word(nodes, root.children, root.reference), 1);
    EXPECT_NE(refusal(folder.file("bad")), "") << root.recipe;
    // A circle of one child, which needs no more room from turn to turn.
    std::string alone = with_word(nodes, root.children, root.reference);
    for (std::size_t lane = 1; lane < 16; ++lane) alone = with_word(alone, root.children + 4 * lane, 0);
    rewrite(folder.file("good"), folder.file("bad"), 3, alone, 1);
    EXPECT_NE(refusal(folder.file("bad")), "") << root.recipe;
    rewrite(folder.file("good"), folder.file("bad"), 2, with_word(facts, offsetof(SavedFacts, stack), 1), 1);
    EXPECT_NE(refusal(folder.file("bad")), "") << root.recipe;
  }
}

TEST(DamagedStructure, ALevelOfAKindThatIsNoLongerReadIsRefusedByItsKind) {
  const Folder folder;
  save(build(sphere(8), "median(leaf=8) > collapse(16) > compressed(16)"), folder.file("good"));
  const std::string facts = section_bytes(folder.file("good"), 2);
  for (const std::uint32_t kind : {0u, 5u, 99u}) {
    rewrite(folder.file("good"), folder.file("bad"), 2, with_word(facts, offsetof(SavedFacts, kind), kind), 1);
    const std::string why = refusal(folder.file("bad"));
    EXPECT_NE(why.find("a level of kind " + std::to_string(kind) + ", which"), std::string::npos) << why;
  }
}

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

using Head = PackedLeafHead;

/// Where the first packed leaf below a node is; 0 if none is.
std::size_t first_packed(const std::string& nodes, std::uint32_t reference = 96) {
  const std::size_t place = reference / 2 * 4;
  if (reference % 2 == 1) return (word_at(nodes, place) & packed_leaf) != 0 ? place : 0;
  std::size_t found = 0;
  for (std::size_t lane = 0; found == 0 && lane < 16; ++lane) {
    const std::uint32_t child = word_at(nodes, place + offsetof(QuantizedNode16, children) + 4 * lane);
    if (child != 0) found = first_packed(nodes, child);
  }
  return found;
}

/// A compressed structure in a file, and a packed leaf of it.
class SavedLeaf {
 public:
  explicit SavedLeaf(const std::string& layout) {
    save(build(sphere(12), "median(leaf=8) > collapse(16) > " + layout), folder_.file("good"));
    nodes_ = section_bytes(folder_.file("good"), 3);
    leaf_ = first_packed(nodes_);
    EXPECT_NE(leaf_, 0u);
  }

  /// Bits of the leaf are put over what is there.
  struct Change {
    std::uint32_t begin, bits, value;
  };
  bool refuses(std::initializer_list<Change> changes) const {
    std::string bytes = nodes_;
    for (const Change& change : changes) {
      for (std::uint32_t i = 0; i < change.bits; ++i) {
        char& byte = bytes[leaf_ + (change.begin + i) / 8];
        const int bit = 1 << (change.begin + i) % 8;
        byte = static_cast<char>((change.value >> i & 1) != 0 ? byte | bit : byte & ~bit);
      }
    }
    rewrite(folder_.file("good"), folder_.file("bad"), 3, bytes, 1);
    return !refusal(folder_.file("bad")).empty();
  }
  bool refuses_forms(std::uint32_t forms) const {
    const std::string facts = section_bytes(folder_.file("good"), 2);
    rewrite(folder_.file("good"), folder_.file("bad"), 2, with_word(facts, offsetof(SavedFacts, leaf_forms), forms), 1);
    return !refusal(folder_.file("bad")).empty();
  }

  Head head() const { return Head(word_at(nodes_, leaf_)); }
  /// Where an axis of the corners begins, in bits.
  std::uint32_t begin_of(std::size_t axis) const {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(nodes_.data() + leaf_);
    std::uint32_t begin = head().begin_of_corners();
    for (std::size_t i = 0; i < axis; ++i) begin += head().bytes_of_axis(head().codes[i], bytes + begin);
    return 8 * begin;
  }
  std::uint32_t forms() const {
    return word_at(section_bytes(folder_.file("good"), 2), offsetof(SavedFacts, leaf_forms));
  }

 private:
  Folder folder_;
  std::string nodes_;
  std::size_t leaf_ = 0;
};

constexpr std::uint32_t begin_of_number = 32, begin_of_more = 31;
/// Without numbers of triangles but the first.
constexpr SavedLeaf::Change no_width{Head::begin_of_width, 4, 0}, no_numbers{Head::begin_of_size, 5, 0};
/// Where all eight triangles have indices.
constexpr std::uint32_t begin_of_indices = 8 * Head::begin_of_indices,
                        begin_of_joined = 8 * Head::begin_of_joined(Head::all_pairs);
constexpr SavedLeaf::Change all_follow{begin_of_joined, 8, 0xfe};

TEST(DamagedStructure, PackedLeavesOfWhatIsNotThereAreRefused) {
  const SavedLeaf leaf("compressed(16, bytes=64)");
  ASSERT_EQ(leaf.forms(), 0u);
  ASSERT_LT(leaf.head().corners, 16u);
  ASSERT_NE(leaf.head().number_bits, 0u);
  EXPECT_FALSE(leaf.refuses({}));
  EXPECT_TRUE(leaf.refuses({{Head::begin_of_codes, 5, Head::code_of_words}})) << "longer than it is";
  EXPECT_TRUE(leaf.refuses({{begin_of_more, 1, 1}})) << "more parts than there are";
  EXPECT_TRUE(leaf.refuses({{begin_of_number, 32, 0x3fffffff}})) << "a triangle that the mesh does not have";
  EXPECT_TRUE(leaf.refuses({{begin_of_indices, 4, 15}})) << "a corner that the leaf does not have";
  EXPECT_FALSE(leaf.refuses({no_width, no_numbers, all_follow}));
  EXPECT_TRUE(leaf.refuses({no_width, no_numbers, {begin_of_joined, 8, 0xff}})) << "no first triangle";
  EXPECT_TRUE(leaf.refuses({{Head::begin_of_width, 4, 9}, no_numbers, all_follow})) << "36 bits per number";
  EXPECT_TRUE(leaf.refuses({all_follow})) << "another count of numbers than there is room for";
  const SavedLeaf::Change points{begin_of_indices, 96, 0};
  EXPECT_FALSE(leaf.refuses({no_width, no_numbers, all_follow, points}));
  EXPECT_TRUE(leaf.refuses({no_width, no_numbers, all_follow, points, {begin_of_number, 32, 0xffffffff}}))
      << "a number that says that more follow";
}

TEST(DamagedStructure, TightLeavesAreRefusedWhereNoneAreSaidToBe) {
  const SavedLeaf plain("compressed(16, bytes=64)");
  const std::uint32_t less = Head::bits_of_code[plain.head().codes[0]] - Head::bits_of_code[Head::first_repeated];
  ASSERT_LE(less, 3u) << "it takes no more room than there is";
  EXPECT_TRUE(plain.refuses({{Head::begin_of_codes, 5, Head::first_repeated}}));
  EXPECT_TRUE(plain.refuses({{Head::begin_of_pairs, 2, 2}}));
  const SavedLeaf tight("compressed(16)");
  ASSERT_NE(tight.forms() & tight_leaves, 0u);
  EXPECT_TRUE(tight.refuses_forms(tight.forms() & ~tight_leaves));
}

TEST(DamagedStructure, FormsOfLeavesThatMeanNothingOrAreNotSaidAreRefused) {
  const SavedLeaf leaf("compressed(16, bytes=18)");
  ASSERT_EQ(leaf.forms(), tight_leaves | named_leaves);
  EXPECT_FALSE(leaf.refuses_forms(leaf.forms()));
  EXPECT_TRUE(leaf.refuses_forms(tight_leaves));
  EXPECT_TRUE(leaf.refuses_forms(leaf.forms() | 4));
  const Folder folder;
  save(build(sphere(8), "binned > wide(16)"), folder.file("good"));
  const std::string facts = with_word(section_bytes(folder.file("good"), 2), offsetof(SavedFacts, leaf_forms), 1);
  rewrite(folder.file("good"), folder.file("bad"), 2, facts, 1);
  EXPECT_NE(refusal(folder.file("bad")), "");
}

TEST(DamagedStructure, TightLeavesThatRepeatCornersThatTheyDoNotHaveAreRefused) {
  const SavedLeaf leaf("compressed(16, bytes=18)");
  const Head head = leaf.head();
  const auto axis = static_cast<std::size_t>(std::ranges::find_if(head.codes, Head::repeats) - head.codes);
  ASSERT_LT(axis, 3u);
  ASSERT_LT(head.corners, 16u);
  const std::uint32_t begin = leaf.begin_of(axis);
  EXPECT_FALSE(leaf.refuses({{begin, 1, 1}}));
  EXPECT_TRUE(leaf.refuses({{begin + head.corners, 1, 1}}));
}

TEST(DamagedStructure, SectionsOfAnotherSizeAreRefused) {
  const Folder folder;
  for (const Case& c : cases()) {
    save(build(c.scene, c.recipe), folder.file("good"));
    const std::size_t levels = c.scene.single_level() ? 1 : c.scene.meshes.size() + 1;
    for (std::size_t section = 0; section < 2 + 3 * levels; ++section) {
      const std::string good = section_bytes(folder.file("good"), section);
      if (good.empty()) continue;
      for (const std::size_t size : {std::size_t{0}, std::size_t{1}, good.size() / 2, good.size() - 1}) {
        rewrite(folder.file("good"), folder.file("bad"), section, good.substr(0, size), levels);
        EXPECT_NE(refusal(folder.file("bad")), "") << c.name << ", section " << section << " cut to " << size;
      }
    }
  }
}

}  // namespace
}  // namespace boxwood
