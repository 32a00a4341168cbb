#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scene/importers/repeated_note.h"

namespace boxwood::pbrt {

/// What was left out or changed, each kind of thing told once, in the order of first appearance.
class Notes {
 public:
  /// `sentence` is called for the first of its kind only.
  template <class Sentence>
  void add(const std::string& kind, const Sentence& sentence) {
    const auto [place, is_new] = index_.try_emplace(kind, notes_.size());
    if (is_new) notes_.emplace_back();
    notes_[place->second].add(sentence);
  }
  void report(std::vector<std::string>& messages) const {
    for (const RepeatedNote& note : notes_) note.report(messages);
  }

 private:
  std::map<std::string, std::size_t> index_;
  std::vector<RepeatedNote> notes_;
};

}  // namespace boxwood::pbrt
