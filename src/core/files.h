// Whole files in and out, with sentences for what can go wrong.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace onde {

/// The file's bytes. Throws InputError when it is missing, a folder, unreadable, or larger than
/// `limit` bytes.
std::string read_file(const std::filesystem::path& path, uint64_t limit = uint64_t(4) << 30);

/// Calls `write` with the name of a temporary file beside `path`, then renames it over `path`, so
/// that `path` is always either its old content or all of the new. The temporary file is removed
/// when `write` throws. The temporary name keeps the extension of `path`.
void replace_file(const std::filesystem::path& path,
                  const std::function<void(const std::filesystem::path&)>& write);

/// Replaces the file by this text. Throws InputError when it can't be written whole.
void write_text(const std::filesystem::path& path, std::string_view text);

/// Throws InputError unless a file could be created at `path` now: its folder exists and is
/// writable, and `path` is not itself a folder. Leaves nothing behind and touches nothing.
void check_writable(const std::filesystem::path& path);

} // namespace onde
