#include "image/basis.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>

namespace onde {
namespace {

namespace fs = std::filesystem;

constexpr const char* LIBRARY = "libonde_basis.so";

/// What tools/basis/transcoder.cpp exports. Returns 1 for success; `rgba` has 4 * pixels bytes.
using Transcode = int (*)(const void* file, size_t size, unsigned width, unsigned height,
                          unsigned char* rgba);

/// The folder of the program, or of the library, that this code is part of.
fs::path own_folder() {
    Dl_info info{};
    std::error_code ignored;
    if (!dladdr(reinterpret_cast<void*>(&transcode_basis), &info) || !info.dli_fname) return {};
    const fs::path own = fs::canonical("/proc/self/exe", ignored);
    const fs::path named = fs::canonical(info.dli_fname, ignored); // argv[0] for a program
    return (named.empty() ? own : named).parent_path();
}

/// What ONDE_BASIS names, else beside the program, in the lib folder beside its own, or wherever
/// the system looks.
void* open_library() {
    if (const char* named = std::getenv("ONDE_BASIS")) return dlopen(named, RTLD_NOW | RTLD_LOCAL);
    const fs::path folder = own_folder();
    for (const fs::path& path : {folder / LIBRARY, folder / "../lib" / LIBRARY, fs::path(LIBRARY)})
        if (void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) return library;
    return nullptr;
}

Transcode find_transcoder() {
    void* library = open_library();
    return library ? reinterpret_cast<Transcode>(dlsym(library, "onde_basis_transcode")) : nullptr;
}

} // namespace

std::vector<uint8_t> transcode_basis(FileBytes file, uint32_t width, uint32_t height) {
    static const Transcode transcode = find_transcoder();
    if (!transcode)
        throw ImageProblem("it is of Basis Universal, whose transcoder is not installed (see "
                           "tools/basis/build.sh)");
    std::vector<uint8_t> rgba(4 * size_t(width) * height);
    if (transcode(file.data(), file.size(), width, height, rgba.data()) != 1)
        throw ImageProblem("its Basis Universal texels are damaged");
    return rgba;
}

} // namespace onde
