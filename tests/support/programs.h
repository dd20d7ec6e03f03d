// The programs that a test executable runs on its device.
#pragma once

#include "gpu/program.h"
#include "support/device.h"
#include "support/folders.h"
#include "support/test_cache.h"

namespace onde::test {

/// The kernels are read from the checkout, so that an edit of one needs no new build of the tests.
inline gpu::KernelSources kernel_sources() {
    return gpu::KernelSources::folder(std::filesystem::path(in_project("kernels")));
}

/// Kept on disk between runs, and in memory for ever, as the device.
inline gpu::Programs& programs() {
    static auto* all = new gpu::Programs(device(), kernel_sources(), test_cache());
    return *all;
}

} // namespace onde::test
