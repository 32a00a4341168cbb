#include "structure/size_limits.h"

#include <fmt/format.h>

#include "boxwood/error.h"

namespace boxwood {

void check_named(std::uint64_t triangles, std::uint64_t instances) {
  if (triangles > most_named) {
    throw Error(fmt::format("a mesh has {} triangles, and at most {} can be told apart; place parts of it as instances",
                            triangles, most_named));
  }
  if (instances > most_named) {
    throw Error(fmt::format("the scene has {} instances, and at most {} can be told apart; merge some of them",
                            instances, most_named));
  }
}

}  // namespace boxwood
