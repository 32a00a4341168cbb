#pragma once
#include "options/options.h"
#include "tree/tree.h"

namespace boxwood {

/// In what order children are stored, and along which axis the node says they ascend.
enum class StoredOrder {
  faithful,  ///< as the original of a study stored them: its axis may have nothing to do with where the children lie
  corrected  ///< ascending along the world axis on which their boxes' centres lie furthest apart
};

template <class T>
void add_stored_order(OptionsOf<T>& options) {
  options.choice("order", static_cast<StoredOrder T::*>(&T::order), {"faithful", "corrected"},
                 "which child is stored first, along which axis: as the study's program did, or as they really lie");
}

/// Puts the children of a binary tree's nodes into the corrected order. O(nodes).
void correct_child_order(Tree& tree);

}  // namespace boxwood
