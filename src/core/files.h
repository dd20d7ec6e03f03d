// Whole files in, with sentences for what can go wrong. Files out are in output.h.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace onde {

/// The file's bytes. Throws InputError when it is missing, a folder, unreadable, or larger than
/// `limit` bytes.
std::string read_file(const std::filesystem::path& path, uint64_t limit = uint64_t(4) << 30);

/// The extension in lower case, with its dot: ".png" of X.PNG.
std::string lower_extension(const std::filesystem::path& path);

/// Whether both are the same place, behind links, be something there or not.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

} // namespace onde
