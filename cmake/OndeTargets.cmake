# What every target of ours has in common.
add_library(onde_options INTERFACE)
target_include_directories(onde_options INTERFACE ${CMAKE_SOURCE_DIR}/src ${CMAKE_SOURCE_DIR}/kernels)
target_compile_definitions(onde_options INTERFACE
  CL_HPP_TARGET_OPENCL_VERSION=120 CL_HPP_MINIMUM_OPENCL_VERSION=120
  CL_TARGET_OPENCL_VERSION=120 CL_HPP_ENABLE_EXCEPTIONS
  GLM_FORCE_SIZE_T_LENGTH GLM_FORCE_EXPLICIT_CTOR GLM_ENABLE_EXPERIMENTAL
  SPDLOG_FMT_EXTERNAL ONDE_VERSION="${PROJECT_VERSION}")
# Users and developers compile with the same flags, so that one build serves both. A warning is an
# error in the compiler that CI has; another compiler's would only disturb who came for a picture.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION MATCHES "^12\\.")
  target_compile_options(onde_options INTERFACE
                         -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Werror)
else()
  target_compile_options(onde_options INTERFACE -w)
endif()
if(ONDE_SANITIZE)
  target_compile_options(onde_options INTERFACE -fsanitize=address,undefined
                         -fno-sanitize-recover=undefined -fno-omit-frame-pointer
                         -Wno-maybe-uninitialized) # false alarms of g++ 12 under sanitizers
  target_link_options(onde_options INTERFACE -fsanitize=address,undefined)
endif()

# onde_library(NAME DEPS libraries...): the folder's .cpp files as a static library.
function(onde_library name)
  cmake_parse_arguments(ARG "" "" "DEPS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_library(${name} STATIC ${sources})
  target_link_libraries(${name} PUBLIC onde_options ${ARG_DEPS})
endfunction()
