#include "gpu/fence.h"

#include "gpu/cl_error.h"

namespace onde::gpu {

Fence::Fence(const Device& device) {
    checked("the device takes no more work", [&] {
        device.queue().enqueueMarkerWithWaitList(nullptr, &event_);
        device.queue().flush();
    });
}

void Fence::wait() const {
    checked("the device failed while working", [&] { event_.wait(); });
}

PendingWord::PendingWord(const Device& device, const Buffer<uint32_t>& buffer, size_t index)
    : word_(std::make_unique<uint32_t>()) {
    checked("a word could not be read from the device", [&] {
        device.queue().enqueueReadBuffer(buffer.raw(), CL_FALSE, index * sizeof(uint32_t),
                                         sizeof(uint32_t), word_.get(), nullptr, &event_);
        device.queue().flush();
    });
}

PendingWord::~PendingWord() {
    if (word_) clWaitForEvents(1, &event_()); // a failure is told by who waits for the work
}

uint32_t PendingWord::wait() const {
    checked("the device failed while working", [&] { event_.wait(); });
    return *word_;
}

} // namespace onde::gpu
