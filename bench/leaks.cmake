add_executable(onde_bench_leaks ${CMAKE_CURRENT_LIST_DIR}/leaks.cpp)
target_link_libraries(onde_bench_leaks PRIVATE onde_chapter onde_bench_shared)
