// The one device that a test executable runs on.
#pragma once

#include "gpu/device.h"

namespace onde::test {

/// Opened at the first call, and never closed: at exit some drivers are gone before our statics.
inline const gpu::Device& device() {
    static const gpu::Device* opened = new gpu::Device(gpu::open_device());
    return *opened;
}

} // namespace onde::test
