# The Embree reference as a competitor; it is built with the tests.
if(TARGET onde_reference)
  find_package(CLI11 REQUIRED)
  add_executable(onde_bench_native_tracer ${CMAKE_CURRENT_LIST_DIR}/native_tracer.cpp)
  target_link_libraries(onde_bench_native_tracer PRIVATE onde_reference onde_scene CLI11::CLI11)
endif()
