#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "boxwood/scene.h"
#include "render/render.h"

namespace boxwood::viewer {

/// Everything that decides what is on the screen. Plain data: the window changes it, the painter paints it.
struct ViewState {
  std::array<std::string, 2> recipes{"default", "default"};
  bool compare = false;  ///< paint with both recipes
  std::string order;     ///< traversal order put in place of the recipes' own; empty: theirs
  std::size_t frame = 0;
  RenderSettings settings;  ///< camera, size, integrator, lights; spp and seed are the painter's

  friend bool operator==(const ViewState&, const ViewState&);
};

/// A recipe with trace(order=…) put in. What cannot be ordered (a peer) stays as it is. Throws UsageError on a recipe
/// that does not parse.
std::string with_order(const std::string& recipe, const std::string& order);

}  // namespace boxwood::viewer
