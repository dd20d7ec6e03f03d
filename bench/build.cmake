file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/build*.cpp)
add_executable(onde_bench_build ${sources})
target_link_libraries(onde_bench_build PRIVATE onde_bench_shared)
