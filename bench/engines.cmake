# The native tracer is the reference of the tests, and is built with them.
if(TARGET onde_reference)
  find_package(CLI11 REQUIRED)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/engines*.cpp)
  add_executable(onde_bench_engines ${sources})
  target_include_directories(onde_bench_engines PRIVATE ${CMAKE_CURRENT_LIST_DIR})
  target_compile_definitions(onde_bench_engines PRIVATE ONDE_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  target_link_libraries(onde_bench_engines PRIVATE onde_render onde_reference CLI11::CLI11)
endif()
