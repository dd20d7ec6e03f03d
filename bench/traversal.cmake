file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/traversal*.cpp)
add_executable(onde_bench_traversal ${sources})
target_link_libraries(onde_bench_traversal PRIVATE onde_bench_shared onde_upload)
# Embree's packets are filled as fast as the host allows: a fair competitor.
set_source_files_properties(${CMAKE_CURRENT_LIST_DIR}/traversal_embree.cpp PROPERTIES
                            COMPILE_OPTIONS "-O3;-march=native")
