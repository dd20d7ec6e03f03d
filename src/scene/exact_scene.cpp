#include "scene/exact_scene.h"

#include "scene/merge.h"
#include "scene/origin.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace onde {

void ExactScene::spend(uint64_t bytes) {
    if (++count_ > MAX_PLACED)
        throw InputError("{}: places more than {} things; place fewer", name_, MAX_PLACED);
    context_.spend(4, bytes, name_); // here, in the scene, and what upload makes of it
}

bool ExactScene::usable(const glm::dmat4& place, Notes& notes) const {
    const glm::mat4 rounded(place);
    bool finite = true;
    for (glm::length_t i = 0; i < 4; ++i)
        for (glm::length_t k = 0; k < 4; ++k) finite = finite && std::isfinite(rounded[i][k]);
    const bool good = finite && std::isnormal(glm::determinant(glm::mat3(rounded)));
    if (!good)
        notes.wrong("Things that are scaled to nothing, or beyond all numbers, are left out");
    return good;
}

void ExactScene::place_mesh(uint32_t mesh, const glm::dmat4& object_to_world, Notes& notes) {
    if (!usable(object_to_world, notes)) return;
    spend(sizeof(Instance) + sizeof(Placed));
    meshes_.push_back({mesh, {}, object_to_world});
}

void ExactScene::place_shape(ShapeKind kind, uint32_t material, const glm::dmat4& object_to_world,
                             Notes& notes) {
    if (!usable(object_to_world, notes)) return;
    spend(sizeof(Shape) + sizeof(Placed));
    shapes_.push_back({material, kind, object_to_world});
}

void ExactScene::place_light(const PointLight& light, const glm::dmat4& to_world) {
    spend(sizeof(PlacedLight<PointLight>));
    point_lights_.push_back({light, to_world});
}

void ExactScene::place_light(const SpotLight& light, const glm::dmat4& to_world) {
    spend(sizeof(PlacedLight<SpotLight>));
    spot_lights_.push_back({light, to_world});
}

void ExactScene::place_light(const DirectionalLight& light, const glm::dmat4& to_world) {
    spend(sizeof(PlacedLight<DirectionalLight>));
    directional_lights_.push_back({light, to_world});
}

void ExactScene::place_camera(const Camera& camera, const glm::dmat4& camera_to_world) {
    spend(sizeof(PlacedLight<Camera>));
    cameras_.push_back({camera, camera_to_world});
}

void ExactScene::place_media(const glm::dmat4& to_ours) {
    if (media_.empty())
        for_each_medium(scene_, [&](const Medium& m) { media_.emplace_back(m.placement); });
    size_t next = 0;
    for_each_medium(scene_, [&](Medium& medium) {
        const glm::dmat4& place = media_[next++];
        if (medium.grid != NO_GRID) medium.placement = glm::mat4(to_ours * place);
    });
}

void ExactScene::place_all(const glm::dmat4& to_ours) {
    scene_.instances.clear();
    for (const Placed& mesh : meshes_)
        scene_.instances.push_back({mesh.of, glm::mat4(to_ours * mesh.place)});
    scene_.spheres.clear();
    scene_.shapes.clear();
    for (const Placed& shape : shapes_) {
        const glm::mat4 place(to_ours * shape.place);
        const float scale = shape.kind == ShapeKind::sphere ? even_scale(place) : 0.0f;
        if (scale > 0.0f)
            scene_.spheres.push_back({glm::vec3(place[3]), scale, shape.of});
        else
            scene_.shapes.push_back({shape.kind, shape.of, 0.25f, place});
    }
#define ONDE_PLACE(Type, list, words)                                                              \
    scene_.list.clear();                                                                           \
    for (const auto& [light, place] : list##_)                                                     \
        scene_.list.push_back(placed(light, glm::mat4(to_ours* place)));
    LIGHT_LISTS(ONDE_PLACE)
#undef ONDE_PLACE
    scene_.cameras.clear();
    for (const auto& [camera, place] : cameras_)
        scene_.cameras.push_back(placed(camera, glm::mat4(to_ours * place)));
    place_media(to_ours);
}

Scene ExactScene::finish(const glm::dmat4& to_ours) {
    place_all(to_ours);
    scene_.origin = origin_of(extent_of(scene_));
    if (scene_.origin != glm::dvec3(0.0))
        place_all(glm::translate(glm::dmat4(1.0), -scene_.origin) * to_ours);
    return std::move(scene_);
}

} // namespace onde
