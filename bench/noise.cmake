add_executable(onde_bench_noise ${CMAKE_CURRENT_LIST_DIR}/noise.cpp)
target_link_libraries(onde_bench_noise PRIVATE onde_session onde_bench_shared)
