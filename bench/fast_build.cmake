# Our quick and our best builders against Embree's, for docs/performance-builders.md: `ninja fast_build_bench`. Not part of
# the default build.
if(TARGET embree)
  add_executable(fast_build_bench EXCLUDE_FROM_ALL ${CMAKE_CURRENT_LIST_DIR}/fast_build_bench.cpp)
  target_link_libraries(fast_build_bench PRIVATE boxwood boxwood_flags boxwood_warnings embree)
endif()
