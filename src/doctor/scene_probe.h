// Probes of kernels/probe/scene.cl over a small scene.
#pragma once

#include "doctor/columns.h"
#include "render/frame.h"
#include "upload/device_scene.h"

namespace onde::doctor {

/// A scene on the device, with the frame of its first camera.
struct SceneOnDevice {
    DeviceScene scene;
    gpu::Buffer<FrameRecord> frame;

    SceneOnDevice(const gpu::Device& device, const Scene& description,
                  const RenderOptions& options = {}, const BvhOptions& bvh = {},
                  const LightOptions& lights = {}, const TextureOptions& textures = {})
        : scene(device, pack_scene(description, bvh, lights, textures)), frame(device, 1) {
        const Camera camera = description.cameras.empty() ? Camera{} : description.cameras[0];
        const FrameRecord record = make_frame(scene.packed(), camera, options);
        frame.write(device, std::span(&record, 1));
    }
};

class SceneProbe {
  public:
    SceneProbe(gpu::Programs& programs, const Scene& description,
               const std::vector<std::string>& names, uint32_t width,
               const RenderOptions& options = {}, const BvhOptions& bvh = {},
               const LightOptions& lights = {}, const std::string& file = "scene.cl",
               const TextureOptions& textures = {})
        : world_(programs.device(), description, options, bvh, lights, textures),
          probe_(programs, file, width, names, world_.scene.packed().features.defines(),
                 {layout_file(world_.scene.packed().features.layout)}) {}

    const PackedScene& packed() const { return world_.scene.packed(); }

    /// See Probe::run().
    Columns run(const std::string& name, const Columns& in, size_t words) {
        return probe_.run(name, in, words, [&](gpu::Kernel& kernel, uint32_t next) {
            kernel.set(next, world_.frame);
            return world_.scene.bind(kernel, next + 1);
        });
    }

  private:
    SceneOnDevice world_;
    Probe probe_;
};

/// Adds a triangle of its own mesh, counter-clockwise from its front.
inline void add_triangle(Scene& scene, glm::vec3 a, glm::vec3 b, glm::vec3 c, Material material) {
    Mesh mesh;
    mesh.positions = {a, b, c};
    mesh.triangles = {glm::uvec3(0, 1, 2)};
    mesh.materials = {uint32_t(scene.materials.size())};
    scene.materials.push_back(std::move(material));
    Instance instance;
    instance.mesh = uint32_t(scene.meshes.size());
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back(instance);
}

/// A scene with something in it, far below everything.
inline Scene scene_with_a_speck() {
    Scene scene;
    add_triangle(scene, {0, -1000, 0}, {0, -1000, 1}, {1, -1000, 0}, {});
    return scene;
}

} // namespace onde::doctor
