// Where the library of Open Image Denoise is, if anywhere. No Python is run to find that of
// Python's package.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace onde {

inline constexpr const char* OIDN_LIBRARY = "libOpenImageDenoise.so.2";

/// Names the library, or a folder that has it, for whoever gives no --denoiser-library.
inline constexpr const char* OIDN_VARIABLE = "ONDE_DENOISER_LIBRARY";

/// The library in a file or folder that a user names: the file itself, or in the folder, its lib,
/// or that of the Python package pyoidn. Throws InputError where there is none. `named_by` is said
/// in that sentence.
std::filesystem::path named_oidn(const std::filesystem::path& place, const char* named_by);

/// Folders in which the interpreters python3 of PATH look for packages, without running one: of
/// their installation, of the virtual environment that one belongs to, of the user, of PYTHONPATH.
std::vector<std::filesystem::path> python_package_folders();

/// The library of the package pyoidn, else that of the system. Nothing where there is neither.
std::optional<std::filesystem::path> installed_oidn();

} // namespace onde
