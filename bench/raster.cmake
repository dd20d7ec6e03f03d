file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/raster*.cpp)
add_executable(onde_bench_raster ${sources})
target_link_libraries(onde_bench_raster PRIVATE onde_chapter onde_bench_shared)
