file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/solvers*.cpp)
add_executable(onde_bench_solvers ${sources})
target_link_libraries(onde_bench_solvers PRIVATE onde_gpu onde_bench_shared)
