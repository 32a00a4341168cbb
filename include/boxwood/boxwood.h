#pragma once
#include "boxwood/box.h"           // IWYU pragma: export
#include "boxwood/counters.h"      // IWYU pragma: export
#include "boxwood/custom.h"        // IWYU pragma: export
#include "boxwood/distance.h"      // IWYU pragma: export
#include "boxwood/error.h"         // IWYU pragma: export
#include "boxwood/expected_use.h"  // IWYU pragma: export
#include "boxwood/hit_filter.h"    // IWYU pragma: export
#include "boxwood/hit_lists.h"     // IWYU pragma: export
#include "boxwood/moving.h"        // IWYU pragma: export
#include "boxwood/ray.h"           // IWYU pragma: export
#include "boxwood/ray_set.h"       // IWYU pragma: export
#include "boxwood/recipe.h"        // IWYU pragma: export
#include "boxwood/saved.h"         // IWYU pragma: export
#include "boxwood/scene.h"         // IWYU pragma: export
#include "boxwood/structure.h"     // IWYU pragma: export
#include "boxwood/transform.h"     // IWYU pragma: export
#include "boxwood/vec3.h"          // IWYU pragma: export
