#pragma once

/// What only the build knows; cmake/build_facts.cmake writes the values.
namespace boxwood::build_facts {

extern const char* const compiler;
extern const char* const flags;
extern const char* const commit;
extern const char* const embree;

}  // namespace boxwood::build_facts
