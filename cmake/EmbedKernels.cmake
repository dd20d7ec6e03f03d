# Puts every file of kernels/ into a library as bytes, so that the program needs no kernel folder.
# Included, this file defines onde_embed_kernels(); run as a script (cmake -P), it writes the .cpp.

if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(ONDE_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})
  get_filename_component(ONDE_KERNELS ${CMAKE_CURRENT_LIST_DIR}/../kernels ABSOLUTE)

  # onde_embed_kernels(TARGET): adds the generated source; it is written again when a file changes.
  function(onde_embed_kernels target)
    set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded_kernels.cpp)
    file(GLOB_RECURSE files CONFIGURE_DEPENDS ${ONDE_KERNELS}/*.h ${ONDE_KERNELS}/*.cl)
    add_custom_command(
      OUTPUT ${output}
      COMMAND ${CMAKE_COMMAND} -DKERNELS=${ONDE_KERNELS} -DOUTPUT=${output} -P ${ONDE_EMBED_SCRIPT}
      DEPENDS ${files} ${ONDE_EMBED_SCRIPT}
      COMMENT "Embedding kernels"
      VERBATIM)
    target_sources(${target} PRIVATE ${output})
  endfunction()
  return()
endif()

# Arrays of bytes, because compilers may limit the length of string literals.
file(GLOB_RECURSE names RELATIVE ${KERNELS} ${KERNELS}/*.h ${KERNELS}/*.cl)
list(SORT names)
list(LENGTH names count)
set(arrays "")
set(table "")
foreach(name IN LISTS names)
  file(READ ${KERNELS}/${name} hex HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${hex}")
  string(MAKE_C_IDENTIFIER "FILE_${name}" identifier)
  # The closing zero keeps the array of an empty file from having no elements.
  string(APPEND arrays "const unsigned char ${identifier}[] = {${bytes}0};\n")
  string(APPEND table "    {\"${name}\", ${identifier}, sizeof(${identifier}) - 1},\n")
endforeach()
file(WRITE ${OUTPUT} "// Written by cmake/EmbedKernels.cmake. Do not edit.
#include \"gpu/embedded_kernels.h\"

#include <array>

namespace onde::gpu {
namespace {
${arrays}
const std::array<EmbeddedFile, ${count}> FILES{{
${table}}};
} // namespace

std::span<const EmbeddedFile> embedded_kernels() { return FILES; }

} // namespace onde::gpu
")
