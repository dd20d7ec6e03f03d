add_executable(onde_bench_merge ${CMAKE_CURRENT_LIST_DIR}/merge.cpp)
target_link_libraries(onde_bench_merge PRIVATE onde_film onde_bench_shared)
