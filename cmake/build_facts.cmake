# Run at every build: cmake -D SOURCE=… -D OUT=… -D COMPILER=… -D FLAGS=… -D EMBREE=… -P build_facts.cmake. Writes the
# file only when something changed, so nothing is compiled anew otherwise.
execute_process(COMMAND git -C "${SOURCE}" describe --always --dirty --abbrev=12 --exclude=*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
if(failed)
  set(commit unknown)
endif()
string(CONFIGURE [[#include "store/build_facts.h"

namespace boxwood::build_facts {

const char* const compiler = "@COMPILER@";
const char* const flags = "@FLAGS@";
const char* const commit = "@commit@";
const char* const embree = "@EMBREE@";

}  // namespace boxwood::build_facts
]] text @ONLY)
file(CONFIGURE OUTPUT "${OUT}" CONTENT "${text}" @ONLY)
