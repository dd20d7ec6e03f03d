if(NOT TARGET embree)
  find_package(embree 3 REQUIRED)
endif()
file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/traversal*.cpp)
add_executable(onde_bench_traversal ${sources})
target_include_directories(onde_bench_traversal PRIVATE ${CMAKE_CURRENT_LIST_DIR})
target_link_libraries(onde_bench_traversal PRIVATE onde_scene onde_accel onde_gpu embree TBB::tbb
                      CLI11::CLI11)
