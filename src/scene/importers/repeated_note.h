#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

namespace boxwood {

/// Says once what happened many times: the first case in words, then how many more there were.
class RepeatedNote {
 public:
  /// `sentence` is called only for the first case.
  template <class Sentence>
  void add(const Sentence& sentence) {
    if (count_++ == 0) first_ = sentence();
  }
  void report(std::vector<std::string>& messages) const {
    if (count_ == 1) messages.push_back(first_);
    if (count_ > 1) messages.push_back(fmt::format("{} ({} more like it)", first_, count_ - 1));
  }

 private:
  std::uint64_t count_ = 0;
  std::string first_;
};

}  // namespace boxwood
