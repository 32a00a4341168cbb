#pragma once
#include <any>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "boxwood/scene.h"
#include "options/options.h"

namespace boxwood {

/// One procedural scene: a registry line. Same options, same scene, bit by bit, on any machine.
struct Generator {
  std::string name;
  std::string summary;
  std::any defaults;  ///< the options struct as it is when nothing is said
  std::vector<Option> options;
  std::function<Scene(const std::any& options)> make;
};

/// Every generator there is, in the order in which `boxwood scenes` prints them.
const std::vector<Generator>& generators();

/// Makes the scene of "NAME" or "NAME(option=value, …)", the text after "generate:". Only scenes that need a point of
/// view of their own have cameras. Throws UsageError that names the nearest valid generator or option.
Scene generate(std::string_view call);

}  // namespace boxwood
