// What renders whole frames in the bench: Onde's engines and the native tracer, behind one face.
#pragma once

#include "engines_variant.h"

#include "session/session.h"
#include "support/reference/reference.h"

namespace onde::bench {

/// The frame that all contenders render, with a box filter and the scene's first camera.
struct FrameOptions {
    uint32_t width = 640, height = 480; ///< pixels
    uint32_t samples = 16;              ///< per pixel
    uint32_t depth = 8;                 ///< the most surfaces of a path

    double paths() const { return double(width) * height * samples; }
};

struct Frame {
    double seconds = 0;
    uint64_t rays = 0; ///< closest-hit and any-hit together
};

class Contender {
  public:
    virtual ~Contender() = default;
    virtual Frame render() = 0;
    /// The mean radiance of the last frame; all are the same.
    virtual Image picture() = 0;
};

/// One engine with one set of settings. The device outlives it.
class OndeEngine : public Contender {
  public:
    /// Compiles the kernels, without any cache of ours.
    OndeEngine(const gpu::Device& device, const Scene& scene, const FrameOptions& frame,
               const Variant& variant);

    Frame render() override;
    Image picture() override { return session_.picture(); }
    double compile_seconds() { return session_.prepare().seconds; }
    const BvhStatistics& bvh() { return session_.packed().bvh.statistics; }

  private:
    gpu::Programs programs_;
    Session session_;
};

/// The Embree path tracer of the tests.
class NativeTracer : public Contender {
  public:
    NativeTracer(const Scene& scene, const FrameOptions& frame, uint32_t threads);

    Frame render() override;
    Image picture() override;
    /// An upper bound, as if the channels of a pixel always erred together, of the standard error
    /// of the picture's mean over pixels and channels. From a single sample per pixel, it is
    /// estimated from the spread over the picture, and higher.
    double standard_error() const;

  private:
    ReferenceOptions options_;
    ReferenceRenderer renderer_;
    ReferenceResult last_;
};

} // namespace onde::bench
