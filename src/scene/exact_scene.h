// A scene in the making whose things are placed in double precision. They become floats once all
// are known, counted from a point near them.
#pragma once

#include "scene/load_context.h"
#include "scene/scene.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace onde {

class ExactScene {
  public:
    /// `name` is the file's. Placing spends what it takes; both must outlive this.
    ExactScene(LoadContext& context, const std::string& name) : context_(context), name_(name) {}

    /// All but what has a place.
    Scene& assets() { return scene_; }

    /// Whether something that is placed so is finite and has a volume; else with a note.
    bool usable(const glm::dmat4& place, Notes& notes) const;

    /// What has no volume left is dropped with a note in `notes`, as are placements that are no
    /// finite numbers.
    void place_mesh(uint32_t mesh, const glm::dmat4& object_to_world, Notes& notes);
    /// A canonical shape; spheres stay spheres where they are scaled evenly.
    void place_shape(ShapeKind kind, uint32_t material, const glm::dmat4& object_to_world,
                     Notes& notes);

    /// The light as it is in the space that the transform places.
    void place_light(const PointLight& light, const glm::dmat4& to_world);
    void place_light(const SpotLight& light, const glm::dmat4& to_world);
    void place_light(const DirectionalLight& light, const glm::dmat4& to_world);

    /// A camera that looks along -Z of its space, +Y up, +X to the right. Lengths scale.
    void place_camera(const Camera& camera, const glm::dmat4& camera_to_world);

    /// Whether nothing that can be seen has been placed.
    bool empty() const { return meshes_.empty() && shapes_.empty(); }

    /// The scene, after `to_ours` has been applied to the world. May be called once.
    Scene finish(const glm::dmat4& to_ours);

  private:
    struct Placed {
        uint32_t of; ///< a mesh, or a material
        ShapeKind kind;
        glm::dmat4 place;
    };
    template <class Light>
    struct PlacedLight {
        Light light;
        glm::dmat4 place;
    };

    void spend(uint64_t bytes);
    void place_all(const glm::dmat4& to_ours);
    void place_media(const glm::dmat4& to_ours);

    LoadContext& context_;
    const std::string& name_;
    Scene scene_;
    uint64_t count_ = 0;
    std::vector<Placed> meshes_, shapes_;
    std::vector<PlacedLight<Camera>> cameras_;
    std::vector<glm::dmat4> media_; ///< in the order of for_each_medium(), before they are placed
#define ONDE_LIST(Type, list, words) std::vector<PlacedLight<Type>> list##_;
    LIGHT_LISTS(ONDE_LIST)
#undef ONDE_LIST
};

} // namespace onde
