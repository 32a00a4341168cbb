# Whole builds read each header once for several sources, which takes half the time; while working on one source, leave
# it off. Sources that Highway compiles once per instruction set stand alone.
option(BOXWOOD_UNITY "Compile several sources at once" OFF)
set(CMAKE_UNITY_BUILD ${BOXWOOD_UNITY})
set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)
function(boxwood_keep_kernels_apart)
  foreach(source ${ARGN})
    file(STRINGS ${source} several_targets REGEX "foreach_target|scalar_targets" LIMIT_COUNT 1)
    if(several_targets)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
endfunction()

# How every room is compiled. No contraction: a fused operation is written where one is meant, so results do not depend
# on the compiler or the instruction set.
add_library(boxwood_flags INTERFACE)
target_compile_options(boxwood_flags INTERFACE -ffp-contract=off -fno-math-errno)
add_library(boxwood_warnings INTERFACE)
target_compile_options(boxwood_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                       -Wnon-virtual-dtor -Woverloaded-virtual -Werror)
# Sources compiled together: what GCC then takes for a header.
target_compile_options(boxwood_warnings INTERFACE $<$<BOOL:${BOXWOOD_UNITY}>:-Wno-subobject-linkage>)
if(BOXWOOD_FUZZ)  # by another compiler than the one whose warnings are heeded
  target_compile_options(boxwood_warnings INTERFACE -Wno-error -w)
endif()
if(BOXWOOD_SANITIZE)
  add_compile_options(-fsanitize=${BOXWOOD_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -g1)
  add_link_options(-fsanitize=${BOXWOOD_SANITIZE})
endif()

find_program(BOXWOOD_CCACHE ccache)
if(BOXWOOD_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${BOXWOOD_CCACHE})
endif()
find_program(BOXWOOD_MOLD mold)
if(BOXWOOD_MOLD)
  add_link_options(-fuse-ld=mold)
endif()

# boxwood_room(NAME DEPENDENCY...): the static library boxwood_NAME from every source under src/NAME.
function(boxwood_room name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  if(NOT sources)
    add_library(boxwood_${name} INTERFACE)
    target_include_directories(boxwood_${name} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>)
    set_property(GLOBAL APPEND PROPERTY BOXWOOD_ROOMS boxwood_${name})
    target_link_libraries(boxwood_${name} INTERFACE ${ARGN})
    return()
  endif()
  boxwood_keep_kernels_apart(${sources})
  add_library(boxwood_${name} STATIC ${sources})
  target_include_directories(boxwood_${name}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
           $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>)
  target_link_libraries(boxwood_${name} PUBLIC ${ARGN} PRIVATE $<BUILD_INTERFACE:boxwood_warnings;boxwood_flags>)
  target_compile_features(boxwood_${name} PUBLIC cxx_std_20)
  set_property(GLOBAL APPEND PROPERTY BOXWOOD_ROOMS boxwood_${name})
endfunction()

# boxwood_build_facts(TARGET): compiler, flags and commit, looked up at every build, compiled into TARGET.
function(boxwood_build_facts target)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
  set(flags "${CMAKE_BUILD_TYPE} ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}} -ffp-contract=off -fno-math-errno")
  if(BOXWOOD_SANITIZE)
    string(APPEND flags " -fsanitize=${BOXWOOD_SANITIZE}")
  endif()
  string(REGEX REPLACE " +" " " flags "${flags}")
  set(facts ${PROJECT_BINARY_DIR}/build_facts.cpp)
  add_custom_target(${target}_facts BYPRODUCTS ${facts} COMMAND ${CMAKE_COMMAND}
    "-DSOURCE=${PROJECT_SOURCE_DIR}" "-DOUT=${facts}" "-DFLAGS=${flags}" "-DEMBREE=${embree_VERSION}"
    "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
    -P ${PROJECT_SOURCE_DIR}/cmake/build_facts.cmake)
  add_dependencies(${target} ${target}_facts)
  target_sources(${target} PRIVATE ${facts})
endfunction()

# boxwood_embed(TARGET NAME FILE): the text of FILE as boxwood::embedded::NAME, compiled into TARGET.
function(boxwood_embed target name file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${file})
  file(READ ${PROJECT_SOURCE_DIR}/${file} text)
  string(CONCAT source "namespace boxwood::embedded {\nextern const char* const ${name};\n"
                "const char* const ${name} = R\"~~~(" "${text}" ")~~~\";\n}  // namespace boxwood::embedded\n")
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/embedded_${name}.cpp CONTENT "@source@" @ONLY)
  target_sources(${target} PRIVATE ${PROJECT_BINARY_DIR}/embedded_${name}.cpp)
endfunction()
