// A library with the functions of Open Image Denoise whose device fails.
#include "denoise/oidn_functions.h"

extern "C" {

onde::OidnDevice oidnNewDevice(int) {
    return nullptr;
}
void oidnSetDeviceInt(onde::OidnDevice, const char*, int) {}
void oidnSetDeviceBool(onde::OidnDevice, const char*, bool) {}
int oidnGetDeviceInt(onde::OidnDevice, const char*) {
    return 0;
}
void oidnCommitDevice(onde::OidnDevice) {}
int oidnGetDeviceError(onde::OidnDevice, const char** message) {
    *message = "this processor is too old";
    return 1;
}
void oidnReleaseDevice(onde::OidnDevice) {}
onde::OidnFilter oidnNewFilter(onde::OidnDevice, const char*) {
    return nullptr;
}
void oidnSetSharedFilterImage(onde::OidnFilter, const char*, void*, int, size_t, size_t, size_t,
                              size_t, size_t) {}
void oidnSetFilterBool(onde::OidnFilter, const char*, bool) {}
void oidnSetFilterInt(onde::OidnFilter, const char*, int) {}
void oidnCommitFilter(onde::OidnFilter) {}
void oidnExecuteFilter(onde::OidnFilter) {}
void oidnReleaseFilter(onde::OidnFilter) {}

} // extern "C"
