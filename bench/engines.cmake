# The native tracer is the reference of the tests, and is built with them.
if(TARGET onde_reference)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/engines*.cpp)
  add_executable(onde_bench_engines ${sources})
  target_link_libraries(onde_bench_engines PRIVATE onde_session onde_reference onde_bench_shared)
endif()
