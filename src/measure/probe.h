#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "boxwood/ray_set.h"
#include "boxwood/scene.h"
#include "boxwood/structure.h"
#include "tree/tree.h"

namespace boxwood {

/// A figure that can be measured, described for tables and queries.
struct Metric {
  std::string name;     ///< "trace_ms"; lower case, the unit in the name where there is one
  std::string unit;     ///< "ms", "bytes", "" for plain numbers
  std::string meaning;  ///< half a sentence
};

/// A measured metric.
struct Value {
  std::string metric;
  double value = 0;
};

/// What a probe may look at.
struct ProbeInput {
  const Scene& scene;
  const Structure& structure;    ///< built by structure.recipe()
  const RaySet* rays = nullptr;  ///< null for probes of a structure
  const RaySetSettings& view;    ///< camera, image size and seed that the rays come from
  double build_cpu_ms = 0;       ///< CPU time that one thread took to build the structure and take its statistics
  unsigned threads = 1;          ///< of the arena that it runs in
  /// The trees behind the structure, one per mesh; none for a peer. Built anew when first asked for.
  std::function<const std::vector<Tree>&()> trees;
  /// What the scene's first view traces; null when no recipe and no probe of the study asks for it.
  const ExpectedUse* use = nullptr;
};

/// What a measurement is about: a structure alone, or a structure and a ray set.
enum class ProbeScope { structure, rays };

/// Measures some metrics of a structure, or of a structure and a ray set. A new one is a file in src/measure/probes and
/// a line in src/measure/probes.cpp; studies then use its metrics by name.
struct Probe {
  std::string name;
  ProbeScope scope;
  /// Timings are taken anew in every repetition, interleaved over the recipes; the rest is the same every time, and is
  /// taken once. A structure is built anew for each repetition of a repeated probe of structures.
  bool repeated;
  std::string summary;
  std::vector<Metric> metrics;
  /// Values of some or all of `metrics`. Runs in an arena of the study's threads; off the clock unless it looks at one.
  std::vector<Value> (*run)(const ProbeInput& input);
};

/// Every probe there is.
const std::vector<Probe>& probes();
/// Throws UsageError naming the nearest probe and all others.
const Probe& find_probe(std::string_view name);
/// Throws UsageError naming the nearest metric and all others.
const Metric& find_metric(std::string_view name);

}  // namespace boxwood
