# What several benches need: models, Embree's scenes, statistics, and what every main() does.
find_package(nlohmann_json REQUIRED)
find_package(TBB REQUIRED)
if(NOT TARGET embree)
  find_package(embree 3 REQUIRED)
endif()
add_library(onde_bench_shared STATIC
  ${CMAKE_CURRENT_LIST_DIR}/embree_scene.cpp ${CMAKE_CURRENT_LIST_DIR}/figures.cpp
  ${CMAKE_CURRENT_LIST_DIR}/front.cpp ${CMAKE_CURRENT_LIST_DIR}/model.cpp
  ${CMAKE_CURRENT_LIST_DIR}/pictures.cpp)
target_include_directories(onde_bench_shared PUBLIC ${CMAKE_CURRENT_LIST_DIR})
set_source_files_properties(
  ${CMAKE_CURRENT_LIST_DIR}/figures.cpp ${CMAKE_CURRENT_LIST_DIR}/engines.cpp
  PROPERTIES COMPILE_DEFINITIONS "ONDE_SOURCE_DIR=\"${CMAKE_SOURCE_DIR}\"")
target_link_libraries(onde_bench_shared PUBLIC onde_scene onde_accel embree TBB::tbb
                      nlohmann_json::nlohmann_json)
