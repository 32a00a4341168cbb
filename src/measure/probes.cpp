// Every probe, one line each. This is the only file that knows them all.
#include "measure/probes/probes.h"

#include <fmt/format.h>

#include "measure/probe.h"
#include "options/suggest.h"

namespace boxwood {

const std::vector<Probe>& probes() {
  static const std::vector<Probe> all = {
      build_probe(), size_probe(), splits_probe(), layout_probe(),  tree_probe(),  quality_probe(),
      slabs_probe(), time_probe(), tests_probe(),  answers_probe(), image_probe(),
  };
  return all;
}

const Probe& find_probe(std::string_view name) {
  std::vector<std::string> names;
  for (const Probe& probe : probes()) {
    if (probe.name == name) return probe;
    names.push_back(probe.name);
  }
  throw UsageError(fmt::format("no probe is called '{}'; {}", name, suggest(name, names)));
}

const Metric& find_metric(std::string_view name) {
  std::vector<std::string> names;
  for (const Probe& probe : probes()) {
    for (const Metric& metric : probe.metrics) {
      if (metric.name == name) return metric;
      names.push_back(metric.name);
    }
  }
  throw UsageError(fmt::format("no metric is called '{}'; {}", name, suggest(name, names)));
}

}  // namespace boxwood
