#include "report/tree_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "report/number_text.h"
#include "report/table.h"

namespace boxwood {
namespace {

/// A bar of up to 40 columns, in eighths of a column; anything above zero shows.
std::string bar(double fraction) {
  constexpr int columns = 40;
  constexpr const char* eighths[] = {"", "▏", "▎", "▍", "▌", "▋", "▊", "▉"};
  if (!(fraction > 0)) return "";
  const int length = std::clamp(static_cast<int>(std::lround(fraction * columns * 8)), 1, columns * 8);
  std::string text;
  for (int i = 0; i < length / 8; ++i) text += "█";
  return text + eighths[length % 8];
}

/// `counts[i]` things of size i; the last entry stands for i and more.
std::string histogram(const std::string& size_head, const std::string& count_head,
                      std::span<const std::uint64_t> counts) {
  const std::uint64_t most = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
  std::uint64_t total = 0;
  for (const std::uint64_t count : counts) total += count;
  if (total == 0) return "";
  Table table({{size_head}, {count_head}, {"share"}, {"", Align::left}});
  for (std::size_t size = 0; size < counts.size(); ++size) {
    if (counts[size] == 0) continue;
    table.add({std::to_string(size), grouped(counts[size]),
               fmt::format("{:.1f} %", 100 * static_cast<double>(counts[size]) / static_cast<double>(total)),
               bar(static_cast<double>(counts[size]) / static_cast<double>(most))});
  }
  return fmt::format("\n{}", table.text());
}

std::string overlap_table(std::span<const double> overlap) {
  if (overlap.empty()) return "";
  const double most = *std::max_element(overlap.begin(), overlap.end());
  Table table({{"level"}, {"sibling overlap"}, {"", Align::left}});
  for (std::size_t level = 0; level < overlap.size(); ++level) {
    table.add({std::to_string(level), significant(overlap[level]), bar(most > 0 ? overlap[level] / most : 0)});
  }
  return fmt::format("\nArea that siblings have in common, over the area of their parents, below each level:\n\n{}",
                     table.text());
}

}  // namespace

std::string tree_text(const TreeStatistics& statistics) {
  Table facts({{"tree", Align::left}, {""}});
  facts.add({"inner nodes", grouped(statistics.inner_nodes)});
  facts.add({"leaves", grouped(statistics.leaves)});
  facts.add({"references", grouped(statistics.references)});
  facts.add({"references per leaf", significant(statistics.leaves == 0 ? 0
                                                                       : static_cast<double>(statistics.references) /
                                                                             static_cast<double>(statistics.leaves))});
  facts.add({"depth, deepest leaf", grouped(statistics.max_depth)});
  facts.add({"depth, mean leaf", significant(statistics.mean_leaf_depth)});
  facts.add({"arity, largest", grouped(statistics.max_arity)});
  facts.add({"arity, mean", significant(statistics.mean_arity)});
  facts.add({fmt::format("SAH cost (C_traversal {}, C_intersection {})", significant(statistics.constants.traversal),
                         significant(statistics.constants.intersection)),
             significant(statistics.sah_cost, 4)});
  facts.add({"memory of the tree", bytes_text(statistics.bytes)});
  return facts.text() + histogram("leaf size", "leaves", statistics.leaf_sizes) +
         histogram("arity", "inner nodes", statistics.arities) + overlap_table(statistics.sibling_overlap);
}

}  // namespace boxwood
