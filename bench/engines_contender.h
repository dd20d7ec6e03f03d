// What renders whole frames in the bench: Onde's engines and the native tracer, behind one face.
#pragma once

#include "engines_variant.h"

#include "gpu/program.h"
#include "image/image.h"
#include "render/render_loop.h"
#include "support/reference/reference.h"
#include "upload/device_scene.h"
#include "upload/layout_choice.h"

#include <memory>
#include <string>

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
    /// The mean radiance of the frames so far, which are all the same.
    virtual Image picture() const = 0;
};

/// One engine with one set of settings. The device and the scene outlive it.
class OndeEngine : public Contender {
  public:
    /// Compiles the kernels, without any cache of ours.
    OndeEngine(const gpu::Device& device, const DeviceScene& scene, const Camera& camera,
               const FrameOptions& frame, const Variant& variant);

    Frame render() override;
    Image picture() const override;
    double compile_seconds() const { return integrator_->build_report().seconds; }

  private:
    gpu::Programs programs_;
    RenderOptions options_;
    std::unique_ptr<Integrator> integrator_;
};

/// The Embree path tracer of the tests.
class NativeTracer : public Contender {
  public:
    NativeTracer(const Scene& scene, const FrameOptions& frame, uint32_t threads);

    Frame render() override;
    Image picture() const override;
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
