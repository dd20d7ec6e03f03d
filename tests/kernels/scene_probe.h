// Probes of kernels/probe/scene.cl over a small scene, on the tests' device.
#pragma once

#include "doctor/scene_probe.h"
#include "kernels/columns.h"

namespace onde::test {

using doctor::add_triangle;
using doctor::scene_with_a_speck;

class SceneOnDevice : public doctor::SceneOnDevice {
  public:
    explicit SceneOnDevice(const Scene& description, const RenderOptions& options = {})
        : doctor::SceneOnDevice(device(), description, options) {}
};

class SceneProbe : public doctor::SceneProbe {
  public:
    SceneProbe(const Scene& description, const std::vector<std::string>& names, uint32_t width = 1,
               const RenderOptions& options = {}, const LightOptions& lights = {},
               const TextureOptions& textures = {})
        : doctor::SceneProbe(programs(), description, names, width, options, {}, lights, "scene.cl",
                             textures) {}
};

} // namespace onde::test
