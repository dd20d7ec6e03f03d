// Several devices of one machine, as a user names them.
#pragma once

#include "gpu/device.h"

namespace onde::gpu {

/// A device, or one in equal parts of its own, which OpenCL calls sub-devices.
struct DeviceChoice {
    size_t index = 0;   ///< as of choose_device()
    uint32_t parts = 1; ///< 1: the device itself

    bool operator==(const DeviceChoice&) const = default;
};

/// What a list of selectors of choose_device() names, "0,2"; one that ends in "/2" is that device
/// in two parts; "all" are all that can be used. What names one device as it is, commas included,
/// is no list. An empty one stands for default_selector(). Throws DeviceError, with the list of
/// what there is, where one matches nothing, InputError for a device that is named twice.
std::vector<DeviceChoice> choose_devices(const std::vector<PlatformReport>& platforms,
                                         std::string_view selectors);

/// Whether it names more than one, parts counted.
bool names_several(std::string_view selectors);

/// Opens them in the order of their names, the parts of a device one after the other. Parts share
/// their device's memory and count a share of it as theirs. Throws DeviceError and InputError.
std::vector<Device> open_devices(std::string_view selectors = {},
                                 Profiling profiling = Profiling::off);

} // namespace onde::gpu
