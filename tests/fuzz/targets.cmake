# One executable a file, for libFuzzer. `./run fuzz NAME` builds them with clang in build/fuzz.
file(GLOB fuzz_targets CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.cpp)
foreach(source ${fuzz_targets})
  get_filename_component(name ${source} NAME_WE)
  add_executable(onde_fuzz_${name} EXCLUDE_FROM_ALL ${source})
  target_include_directories(onde_fuzz_${name} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_link_libraries(onde_fuzz_${name} PRIVATE onde_scene)
  target_link_options(onde_fuzz_${name} PRIVATE -fsanitize=fuzzer)
endforeach()
