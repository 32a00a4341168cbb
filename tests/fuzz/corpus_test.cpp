// The kept inputs of every fuzz target, and every beginning of the shorter ones, without libFuzzer.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz/targets.h"

namespace boxwood::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> corpus_of(const Target& target) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(BOXWOOD_FUZZ_CORPUS) / target.name)) {
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

std::vector<std::uint8_t> bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class FuzzCorpus : public ::testing::TestWithParam<Target> {};

TEST_P(FuzzCorpus, IsReadOrRefused) {
  const std::vector<fs::path> files = corpus_of(GetParam());
  ASSERT_FALSE(files.empty());
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    GetParam().run(bytes_of(file));
  }
}

TEST_P(FuzzCorpus, CutAnywhereIsReadOrRefused) {
  // Geometry is taken float by float: a few lengths say it all.
  const std::size_t most_cuts = GetParam().run == trace_geometry ? 10 : 400;
  for (const fs::path& file : corpus_of(GetParam())) {
    SCOPED_TRACE(file.string());
    const std::vector<std::uint8_t> bytes = bytes_of(file);
    const std::size_t step = bytes.size() / most_cuts + 1;
    for (std::size_t size = 0; size < bytes.size(); size += step) GetParam().run(Bytes(bytes).first(size));
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzCorpus, ::testing::ValuesIn(targets().begin(), targets().end()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace boxwood::fuzz
