// A model as a scene of Embree's, and what building it took.
#pragma once

#include "model.h"

#include <embree3/rtcore.h>

#include <memory>

namespace onde::bench {

class EmbreeScene {
  public:
    /// Commits the triangles, which are copied first, with Embree's default scene flags (not
    /// compact, not robust). Throws when Embree fails.
    EmbreeScene(const Model& model, RTCBuildQuality quality);

    RTCScene get() const { return scene_.get(); }
    RTCDevice device() const { return device_.get(); }

    double build_seconds() const { return build_seconds_; } ///< of rtcCommitScene alone
    /// Of the tree, and the most while it was built, as Embree's memory monitor counts them; the
    /// copied triangles are not among them.
    uint64_t bytes() const { return uint64_t(memory_->now); }
    uint64_t peak_bytes() const { return uint64_t(memory_->peak); }

  private:
    struct Memory {
        int64_t now = 0, peak = 0;
    };
    template <class Object, void (*RELEASE)(Object)>
    struct Release {
        using pointer = Object;
        void operator()(Object object) const { RELEASE(object); }
    };
    static bool count_bytes(void* memory, ssize_t bytes, bool);
    void check() const;

    std::unique_ptr<Memory> memory_ = std::make_unique<Memory>();
    std::unique_ptr<RTCDevice, Release<RTCDevice, rtcReleaseDevice>> device_;
    std::unique_ptr<RTCScene, Release<RTCScene, rtcReleaseScene>> scene_;
    double build_seconds_ = 0;
};

} // namespace onde::bench
