# Our kernels against Embree's, for docs/performance.md: `ninja trace_bench`. Not part of the default build.
if(TARGET embree)
  add_executable(trace_bench EXCLUDE_FROM_ALL ${CMAKE_CURRENT_LIST_DIR}/trace_bench.cpp)
  target_link_libraries(trace_bench PRIVATE boxwood boxwood_flags boxwood_warnings embree)
endif()
