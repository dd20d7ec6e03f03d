// The functions of Open Image Denoise's C interface that we call: declared here and looked up in a
// library that is opened at run time. Nothing of it is included or linked.
#pragma once

#include <cstddef>
#include <filesystem>

namespace onde {

using OidnDevice = struct OidnDeviceHandle*;
using OidnFilter = struct OidnFilterHandle*;

/// Numbers of its enums.
inline constexpr int OIDN_CPU = 1; ///< the default would load its GPU modules too
inline constexpr int OIDN_FLOAT3 = 3;

/// Each once: (result, name, parameters).
#define ONDE_OIDN_FUNCTIONS(FUNCTION)                                                              \
    FUNCTION(OidnDevice, oidnNewDevice, int)                                                       \
    FUNCTION(void, oidnSetDeviceInt, OidnDevice, const char*, int)                                 \
    FUNCTION(void, oidnSetDeviceBool, OidnDevice, const char*, bool)                               \
    FUNCTION(int, oidnGetDeviceInt, OidnDevice, const char*)                                       \
    FUNCTION(void, oidnCommitDevice, OidnDevice)                                                   \
    FUNCTION(int, oidnGetDeviceError, OidnDevice, const char**)                                    \
    FUNCTION(void, oidnReleaseDevice, OidnDevice)                                                  \
    FUNCTION(OidnFilter, oidnNewFilter, OidnDevice, const char*)                                   \
    FUNCTION(void, oidnSetSharedFilterImage, OidnFilter, const char*, void*, int, size_t, size_t,  \
             size_t, size_t, size_t)                                                               \
    FUNCTION(void, oidnSetFilterBool, OidnFilter, const char*, bool)                               \
    FUNCTION(void, oidnSetFilterInt, OidnFilter, const char*, int)                                 \
    FUNCTION(void, oidnCommitFilter, OidnFilter)                                                   \
    FUNCTION(void, oidnExecuteFilter, OidnFilter)                                                  \
    FUNCTION(void, oidnReleaseFilter, OidnFilter)

struct OidnFunctions {
#define ONDE_OIDN_MEMBER(result, name, ...) result (*name)(__VA_ARGS__) = nullptr;
    ONDE_OIDN_FUNCTIONS(ONDE_OIDN_MEMBER)
#undef ONDE_OIDN_MEMBER
};

/// Opens the library, which stays open until the process ends, as its threads do. A name without a
/// folder is looked for where the system keeps libraries. Throws InputError where it can't be
/// opened or is no Open Image Denoise of version 2.
OidnFunctions open_oidn(const std::filesystem::path& library);

} // namespace onde
