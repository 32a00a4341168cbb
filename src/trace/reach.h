#pragma once

namespace boxwood {

/// What prepare() must know of everything below a root.
struct Reach {
  float reach = 0;
  float gain = 1;
};

}  // namespace boxwood
