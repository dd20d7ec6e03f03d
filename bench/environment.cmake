add_executable(onde_bench_environment
  ${CMAKE_CURRENT_LIST_DIR}/environment.cpp ${CMAKE_CURRENT_LIST_DIR}/variance.cpp)
target_link_libraries(onde_bench_environment PRIVATE onde_session onde_bench_shared)
