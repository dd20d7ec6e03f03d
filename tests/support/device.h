// The one device that a test executable runs on.
#pragma once

#include "gpu/device.h"

namespace onde::test {

/// Opened at the first call.
inline const gpu::Device& device() {
    static const gpu::Device opened = gpu::open_device();
    return opened;
}

} // namespace onde::test
