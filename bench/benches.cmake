include(${CMAKE_CURRENT_LIST_DIR}/native_tracer.cmake OPTIONAL)
include(${CMAKE_CURRENT_LIST_DIR}/traversal.cmake)
