# The fuzz targets. In every build: the kept corpus as tests. With -DBOXWOOD_FUZZ=ON and Clang: the program `fuzz` for
# scripts/fuzz.sh.
set(fuzz_rooms boxwood_soak boxwood_study boxwood_saved)
boxwood_test(fuzz ${fuzz_rooms})
target_compile_definitions(test_fuzz PRIVATE BOXWOOD_FUZZ_CORPUS="${CMAKE_CURRENT_LIST_DIR}/corpus")
if(BOXWOOD_FUZZ)
  add_executable(fuzz ${CMAKE_CURRENT_LIST_DIR}/libfuzzer/entry.cpp ${CMAKE_CURRENT_LIST_DIR}/targets.cpp
                 ${CMAKE_CURRENT_LIST_DIR}/importers.cpp ${CMAKE_CURRENT_LIST_DIR}/files.cpp ${CMAKE_CURRENT_LIST_DIR}/geometry.cpp)
  target_include_directories(fuzz PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(fuzz PRIVATE ${fuzz_rooms} boxwood_flags)
  target_link_options(fuzz PRIVATE -fsanitize=fuzzer)
endif()
