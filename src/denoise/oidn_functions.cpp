#include "denoise/oidn_functions.h"

#include "core/error.h"

#include <dlfcn.h>

namespace onde {
namespace {

template <class Function>
void look_up(void* library, const char* name, Function*& function,
             const std::filesystem::path& path) {
    function = reinterpret_cast<Function*>(dlsym(library, name));
    if (!function)
        throw InputError("{}: this library is no Open Image Denoise of version 2, it has no {}; "
                         "name another with --denoiser-library, or take --denoise onde",
                         path.string(), name);
}

} // namespace

OidnFunctions open_oidn(const std::filesystem::path& path) {
    void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        const char* reason = dlerror();
        throw InputError("{}: this library can't be opened ({}); name another with "
                         "--denoiser-library, or take --denoise onde",
                         path.string(), reason ? reason : "no reason is given");
    }
    OidnFunctions functions;
#define ONDE_OIDN_LOOK_UP(result, name, ...) look_up(library, #name, functions.name, path);
    ONDE_OIDN_FUNCTIONS(ONDE_OIDN_LOOK_UP)
#undef ONDE_OIDN_LOOK_UP
    return functions;
}

} // namespace onde
