# The figures of docs/performance.md: `ninja trace_bench triangle_bench`. Not part of the default build.
add_executable(triangle_bench EXCLUDE_FROM_ALL ${CMAKE_CURRENT_LIST_DIR}/triangle_bench.cpp)
target_include_directories(triangle_bench PRIVATE ${CMAKE_CURRENT_LIST_DIR})
target_link_libraries(triangle_bench PRIVATE boxwood_measure boxwood_layout boxwood_flags boxwood_warnings)

if(TARGET embree)
  add_executable(trace_bench EXCLUDE_FROM_ALL ${CMAKE_CURRENT_LIST_DIR}/trace_bench.cpp)
  target_link_libraries(trace_bench PRIVATE boxwood boxwood_flags boxwood_warnings embree)
endif()
