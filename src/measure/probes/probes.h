#pragma once
#include "measure/probe.h"

namespace boxwood {

Probe build_probe();
Probe size_probe();
Probe splits_probe();
Probe layout_probe();
Probe tree_probe();
Probe quality_probe();
Probe slabs_probe();
Probe time_probe();
Probe tests_probe();
Probe answers_probe();
Probe image_probe();

}  // namespace boxwood
