add_executable(onde_bench_emitters
  ${CMAKE_CURRENT_LIST_DIR}/emitters.cpp ${CMAKE_CURRENT_LIST_DIR}/variance.cpp)
target_link_libraries(onde_bench_emitters PRIVATE onde_session onde_bench_shared)
