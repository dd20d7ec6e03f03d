// Buffer views compressed by EXT_meshopt_compression or KHR_meshopt_compression. Decoded by
// libmeshoptimizer but for what is newer than it.
#pragma once

#include "scene/gltf/document.h"

#include <cstdint>
#include <span>
#include <string>

namespace onde::gltf {

/// The bytes of the view: `count` elements of `stride` bytes. Throws InputError, beginning with
/// `where`, for a damaged stream. The memory is to be spent from the budget before.
std::string decode_meshopt(const Meshopt& source, std::span<const uint8_t> stream,
                           const std::string& where);

/// Attribute streams of version 1 (KHR_meshopt_compression, appendix A, mode 0), whose first byte
/// is 0xa1. `stride` is a multiple of 4 up to 256. Returns false for a damaged stream.
bool decode_meshopt_attributes(std::span<const uint8_t> stream, size_t count, size_t stride,
                               uint8_t* result);

} // namespace onde::gltf
