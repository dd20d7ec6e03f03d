// An OpenCL driver, loaded by the real loader, that fails where installed drivers have been seen to
// fail: one platform cannot list its devices, another has devices that stop answering.
#include <CL/cl.h>
#include <CL/cl_ext.h>
#include <CL/cl_icd.h>

#include <algorithm>
#include <cstring>
#include <string>

// The loader asks for platforms and devices to begin with a pointer to their functions.
struct _cl_platform_id {
    const cl_icd_dispatch* functions;
    const char* name;
};
struct _cl_device_id {
    const cl_icd_dispatch* functions;
};

namespace {

extern _cl_platform_id platforms[2];
extern _cl_device_id silent_device, twofold_device;

cl_int answer(const std::string& text, size_t size, void* value, size_t* needed) {
    if (needed) *needed = text.size() + 1;
    if (value) std::memcpy(value, text.c_str(), std::min(size, text.size() + 1));
    return CL_SUCCESS;
}

cl_int CL_API_CALL get_device_ids(cl_platform_id platform, cl_device_type, cl_uint room,
                                  cl_device_id* devices, cl_uint* count) {
    if (platform == &platforms[0]) return CL_OUT_OF_HOST_MEMORY;
    if (room > 0 && devices) devices[0] = &silent_device;
    if (room > 1 && devices) devices[1] = &twofold_device;
    if (count) *count = 2;
    return CL_SUCCESS;
}

/// The twofold device says that it is a CPU and a GPU before it, too, falls silent.
cl_int CL_API_CALL get_device_info(cl_device_id device, cl_device_info info, size_t size,
                                   void* value, size_t* needed) {
    const bool is_silent = device == &silent_device;
    if (info == CL_DEVICE_NAME)
        return answer(is_silent ? "Silent Card" : "Twofold Card", size, value, needed);
    if (is_silent) return CL_OUT_OF_RESOURCES;
    if (info == CL_DEVICE_VENDOR || info == CL_DRIVER_VERSION)
        return answer("broken", size, value, needed);
    if (info != CL_DEVICE_TYPE || size < sizeof(cl_device_type)) return CL_OUT_OF_RESOURCES;
    const cl_device_type type = CL_DEVICE_TYPE_CPU | CL_DEVICE_TYPE_GPU;
    if (value) std::memcpy(value, &type, sizeof type);
    return CL_SUCCESS;
}

cl_int CL_API_CALL keep_device(cl_device_id) {
    return CL_SUCCESS;
}

// Not under their public names, which would resolve to the loader's own functions.
cl_int CL_API_CALL get_platform_info(cl_platform_id platform, cl_platform_info info, size_t size,
                                     void* value, size_t* needed) {
    switch (info) {
    case CL_PLATFORM_NAME:
        return answer(platform->name, size, value, needed);
    case CL_PLATFORM_VERSION:
        return answer("OpenCL 1.2 broken", size, value, needed);
    case CL_PLATFORM_EXTENSIONS:
        return answer("cl_khr_icd", size, value, needed);
    case CL_PLATFORM_ICD_SUFFIX_KHR:
        return answer("BROKEN", size, value, needed);
    default:
        return answer("", size, value, needed);
    }
}

cl_int CL_API_CALL get_platform_ids(cl_uint room, cl_platform_id* ids, cl_uint* count) {
    for (cl_uint i = 0; ids && i < std::min(room, 2u); ++i) ids[i] = &platforms[i];
    if (count) *count = 2;
    return CL_SUCCESS;
}

const cl_icd_dispatch FUNCTIONS = [] {
    cl_icd_dispatch functions{};
    functions.clGetPlatformInfo = get_platform_info;
    functions.clGetDeviceIDs = get_device_ids;
    functions.clGetDeviceInfo = get_device_info;
    functions.clRetainDevice = keep_device;
    functions.clReleaseDevice = keep_device;
    return functions;
}();

_cl_platform_id platforms[2] = {{&FUNCTIONS, "Speechless"}, {&FUNCTIONS, "Half There"}};
_cl_device_id silent_device = {&FUNCTIONS}, twofold_device = {&FUNCTIONS};

} // namespace

extern "C" CL_API_ENTRY void* CL_API_CALL clGetExtensionFunctionAddress(const char* name) {
    if (std::strcmp(name, "clIcdGetPlatformIDsKHR") == 0)
        return reinterpret_cast<void*>(get_platform_ids);
    if (std::strcmp(name, "clGetPlatformInfo") == 0)
        return reinterpret_cast<void*>(get_platform_info);
    return nullptr;
}
