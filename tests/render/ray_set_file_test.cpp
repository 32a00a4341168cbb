#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include "boxwood/error.h"
#include "boxwood/ray_set.h"
#include "render/test_scenes.h"

namespace boxwood {
namespace {

using testing_scenes::ScratchFolder;

std::vector<RaySet> sample_sets() {
  const float infinity = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  return {{"primary", Query::closest_hit, {{{1, 2, 3}, 0, {-0.0f, 0, 1}, infinity}, {{nan, 0, 0}, -1, {0, 0, 0}, 7}}},
          {"a-name-longer-than-16", Query::any_hit, {{{1e-40f, 0, 0}, 0, {1, 0, 0}, 0.5f}}},
          {"shadow", Query::any_hit, {}}};
}

std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const std::filesystem::path& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string error_of(const std::filesystem::path& file) {
  try {
    load_ray_sets(file);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(RaySetFile, LoadsWhatWasSavedToTheBit) {
  const ScratchFolder folder;
  const auto sets = sample_sets();
  save_ray_sets(folder.file("a.rays"), sets);
  const auto loaded = load_ray_sets(folder.file("a.rays"));
  ASSERT_EQ(loaded.size(), sets.size());
  for (std::size_t i = 0; i < sets.size(); ++i) {
    EXPECT_EQ(loaded[i].kind, sets[i].kind);
    EXPECT_EQ(loaded[i].query, sets[i].query);
    ASSERT_EQ(loaded[i].rays.size(), sets[i].rays.size());
    for (std::size_t r = 0; r < sets[i].rays.size(); ++r) {
      EXPECT_EQ(std::memcmp(&loaded[i].rays[r], &sets[i].rays[r], sizeof(Ray)), 0);
    }
  }
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(RaySetFile, HasTheDocumentedBytes) {
  const ScratchFolder folder;
  const std::vector<RaySet> sets = {{"ao", Query::any_hit, {{{1, 0, 0}, 0, {0, 1, 0}, 2}}}};
  save_ray_sets(folder.file("a.rays"), sets);
  const std::string bytes = read_bytes(folder.file("a.rays"));
  ASSERT_EQ(bytes.size(), 16u + 16 + 16 + 32 + 8);
  EXPECT_EQ(bytes.substr(0, 8), "BOXWRAYS");
  EXPECT_EQ(bytes.substr(8, 8), std::string("\1\0\0\0\1\0\0\0", 8));
  EXPECT_EQ(bytes.substr(16, 16), std::string("\2\0\0\0\1\0\0\0\1\0\0\0\0\0\0\0", 16));
  EXPECT_EQ(bytes.substr(32, 16), "ao" + std::string(14, '\0'));
  EXPECT_EQ(bytes.substr(48, 4), std::string("\0\0\x80\x3f", 4));
  std::uint64_t hash = 0xcbf29ce484222325u, stored = 0;
  for (const char c : bytes.substr(0, 80)) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  std::memcpy(&stored, bytes.data() + 80, 8);
  EXPECT_EQ(hash, stored);
}

TEST(RaySetFile, TruncatedAnywhereIsRefusedByName) {
  const ScratchFolder folder;
  save_ray_sets(folder.file("good.rays"), sample_sets());
  const std::string bytes = read_bytes(folder.file("good.rays"));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    write_bytes(folder.file("cut.rays"), std::string_view(bytes).substr(0, size));
    ASSERT_NE(error_of(folder.file("cut.rays")).find("cut.rays"), std::string::npos) << size;
  }
}

TEST(RaySetFile, AFlippedBitInAnyByteIsRefused) {
  const ScratchFolder folder;
  save_ray_sets(folder.file("good.rays"), sample_sets());
  const std::string bytes = read_bytes(folder.file("good.rays"));
  for (std::size_t byte = 0; byte < bytes.size(); ++byte) {
    std::string damaged = bytes;
    damaged[byte] = static_cast<char>(damaged[byte] ^ (1 << (byte % 8)));
    write_bytes(folder.file("bad.rays"), damaged);
    ASSERT_NE(error_of(folder.file("bad.rays")), "") << "byte " << byte;
  }
}

TEST(RaySetFile, AppendedBytesAndOtherFilesAreRefused) {
  const ScratchFolder folder;
  save_ray_sets(folder.file("good.rays"), sample_sets());
  write_bytes(folder.file("long.rays"), read_bytes(folder.file("good.rays")) + "x");
  EXPECT_NE(error_of(folder.file("long.rays")).find("follow its checksum"), std::string::npos);
  write_bytes(folder.file("text.rays"), "This is no ray set file at all.");
  EXPECT_NE(error_of(folder.file("text.rays")).find("does not begin with BOXWRAYS"), std::string::npos);
  EXPECT_NE(error_of(folder.file("missing.rays")).find("missing.rays': No such file"), std::string::npos);
  EXPECT_NE(error_of(folder.file(".")), "");
}

TEST(RaySetFile, AbsurdCountsAreRefusedBeforeMemoryIsTaken) {
  const ScratchFolder folder;
  save_ray_sets(folder.file("good.rays"), sample_sets());
  std::string bytes = read_bytes(folder.file("good.rays"));
  bytes.replace(24, 8, 8, '\x7f');
  write_bytes(folder.file("bad.rays"), bytes);
  EXPECT_NE(error_of(folder.file("bad.rays")).find("more than the file holds"), std::string::npos);
}

TEST(RaySetFile, KindsThatCouldNotBeReadAreNotWritten) {
  const ScratchFolder folder;
  for (const std::string& kind :
       {std::string(), std::string("two words"), std::string(65, 'x'), std::string("a\0b", 3)}) {
    const std::vector<RaySet> sets = {{kind, Query::any_hit, {}}};
    EXPECT_THROW(save_ray_sets(folder.file("a.rays"), sets), UsageError);
  }
  EXPECT_EQ(folder.entries(), 0u);
}

}  // namespace
}  // namespace boxwood
