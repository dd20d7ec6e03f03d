// Waiting for a point of the queue, and for a word on its way to the host.
#pragma once

#include "gpu/buffer.h"

#include <memory>

namespace onde::gpu {

/// A point behind all that was queued so far. Handing it out has the device start on that.
class Fence {
  public:
    explicit Fence(const Device& device);
    /// Until the device has come here. Throws DeviceError when the work failed.
    void wait() const;

  private:
    cl::Event event_;
};

/// One word of a buffer, read behind all that was queued so far, while the host goes on.
class PendingWord {
  public:
    PendingWord(const Device& device, const Buffer<uint32_t>& buffer, size_t index);
    PendingWord(PendingWord&&) = default;
    ~PendingWord(); ///< waits: the device may still write
    /// Waits for it. Throws DeviceError when the work before it failed.
    uint32_t wait() const;

  private:
    std::unique_ptr<uint32_t> word_; // stays where it is when this moves
    cl::Event event_;
};

} // namespace onde::gpu
