include(${CMAKE_CURRENT_LIST_DIR}/engines.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/traversal.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/solvers.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/leaks.cmake)
