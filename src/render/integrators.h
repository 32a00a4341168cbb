#pragma once
#include "render/integrator.h"

namespace boxwood {

Integrator eyelight_integrator();
Integrator ao_integrator();
Integrator normals_integrator();
Integrator heatmap_integrator();
Integrator path_integrator();
Integrator whitted_integrator();

}  // namespace boxwood
