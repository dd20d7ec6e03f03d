#include "scene/gltf/placement.h"

#include "core/error.h"
#include "scene/merge.h"
#include "scene/origin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace onde::gltf {

namespace {

/// The transform of what is counted from `from`, counted from `origin`.
glm::mat4 recounted(glm::dmat4 to_world, const glm::dvec3& from, const glm::dvec3& origin) {
    if (from != origin || from != glm::dvec3(0.0))
        to_world[3] += glm::dvec4(glm::dmat3(to_world) * from - origin, 0.0);
    return glm::mat4(to_world);
}

std::vector<Extent> boxes_of(const Scene& scene, const std::vector<glm::dvec3>& origins) {
    std::vector<Extent> boxes;
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        const Extent box = extent_of(scene.meshes[i]);
        boxes.push_back({box.low + origins[i], box.high + origins[i]});
    }
    return boxes;
}

/// Some of the triangles of one of `meshes` that are placed.
void add_details(const Mesh& mesh, const glm::dvec3& origin, const glm::dmat4& to_world,
                 size_t meshes, SceneExtent& extent) {
    for (Detail detail : details_of(mesh, most_details(meshes))) {
        detail.middle += origin;
        extent.details.push_back(transformed(detail, to_world));
    }
}

/// Counts the positions of meshes that are far out by themselves, but not in the scene, from a
/// point near them: what places them would cancel most of their digits.
void centre_meshes(const std::vector<Placement>& placements, const std::vector<Extent>& boxes,
                   std::vector<glm::dvec3>& origins, Scene& scene) {
    std::vector<bool> cancels(scene.meshes.size(), false);
    for (const Placement& placement : placements) {
        const glm::dvec3 origin = origin_of(boxes[placement.index]);
        const glm::dvec3 turned = glm::dmat3(placement.to_world) * origin;
        const glm::dvec3 placed = turned + glm::dvec3(placement.to_world[3]) - scene.origin;
        if (8.0 * glm::length(placed) < glm::length(turned)) cancels[placement.index] = true;
    }
    for (size_t i = 0; i < cancels.size(); ++i) {
        if (!cancels[i]) continue;
        const glm::dvec3 origin = origin_of(boxes[i]), step = origins[i] - origin;
        for (glm::vec3& p : scene.meshes[i].positions) p = glm::vec3(glm::dvec3(p) + step);
        origins[i] = origin;
    }
}

void add_camera(File& file, const Placement& placement, const glm::mat4& to_world, Scene& scene) {
    const std::string user = fmt::format("node {}", placement.node);
    const CameraSource& source = at(file, file.document.cameras, placement.index, "camera", user);
    const std::string name = fmt::format("camera {}", placement.index);
    if (is_flat(to_world)) {
        file.notes.wrong("Cameras scaled to nothing are skipped", user);
        return;
    }
    Camera camera;
    camera.name = source.name;
    camera.camera_to_world = rigid_part(to_world);
    if (!source.perspective) {
        if (!(source.ymag > 0.0))
            throw InputError("{}: {}: its ymag {} is not above 0; export it again", file.name, name,
                             source.ymag);
        camera.orthographic_height = float(2.0 * source.ymag);
    } else if (source.yfov > 0.0 && source.yfov < std::numbers::pi) {
        camera.vertical_fov = float(source.yfov);
    } else {
        throw InputError("{}: {}: its yfov {} does not lie between 0 and pi; export it again",
                         file.name, name, source.yfov);
    }
    const double aspect = source.aspect_ratio.value_or(0.0);
    if (aspect >= 1e-3 && aspect <= 1e3) camera.aspect_ratio = float(aspect);
    file.context.spend(1, sizeof(Camera), file.where(user));
    scene.cameras.push_back(camera);
}

/// Candela and lux are taken as W/sr and W/m^2: only ratios show in a picture.
void add_light(File& file, const Placement& placement, const glm::mat4& to_world, Scene& scene) {
    const std::string user = fmt::format("node {}", placement.node);
    const LightSource& source = at(file, file.document.lights, placement.index, "light", user);
    const glm::vec3 color(source.color[0], source.color[1], source.color[2]);
    const glm::vec3 intensity = glm::max(color, 0.0f) * std::max(0.0f, float(source.intensity));
    file.context.spend(1, 256, file.where(user)); // with its record and its weight
    if (source.type == "directional") {
        if (is_flat(to_world)) return;
        const glm::vec3 to_light = glm::normalize(glm::vec3(to_world[2])); // it shines along -Z
        scene.directional_lights.push_back({to_light, intensity});
    } else if (source.type == "spot") {
        if (is_flat(to_world)) return;
        SpotLight spot{glm::vec3(to_world[3]), glm::normalize(glm::vec3(to_world[2])), intensity};
        spot.half_angle = float(std::clamp(source.outer_cone, 0.002, 0.5 * std::numbers::pi));
        spot.inner_angle = float(std::clamp(source.inner_cone, 0.0, source.outer_cone));
        scene.spot_lights.push_back(spot);
    } else {
        scene.point_lights.push_back({glm::vec3(to_world[3]), intensity});
    }
}

/// A name for each node of the file, by its number: a node keeps that from frame to frame, whatever
/// comes or goes.
uint32_t name_of(const Placement& placement, const Document& document, Scene& scene) {
    scene.names[placement.node] = {document.nodes[placement.node].name,
                                   document.nodes[placement.top].name};
    return placement.node;
}

} // namespace

bool is_flat(const glm::mat4& m) {
    const glm::mat4 inverse = glm::inverse(m);
    return glm::determinant(m) == 0.0f || !std::all_of(&inverse[0][0], &inverse[0][0] + 16,
                                                       [](float x) { return std::isfinite(x); });
}

std::optional<glm::dmat4> with_thickness(const glm::dmat4& m) {
    constexpr double THICKNESS = 1e-4, NO_AREA = 1e-12;
    if (!is_flat(glm::mat4(m))) return m;
    const glm::dvec3 x(m[0]), y(m[1]), z(m[2]);
    const double size = std::max({glm::length(x), glm::length(y), glm::length(z)});
    // Of a plane, its normal times the direction that it loses.
    const glm::dmat3 cofactors(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
    const double area =
        std::hypot(glm::length(cofactors[0]), glm::length(cofactors[1]), glm::length(cofactors[2]));
    if (!(area > NO_AREA * size * size)) return std::nullopt;
    glm::dmat4 thick = m;
    for (glm::length_t i = 0; i < 3; ++i)
        thick[i] += glm::dvec4(THICKNESS * size / area * cofactors[i], 0.0);
    if (is_flat(glm::mat4(thick))) return std::nullopt;
    return thick;
}

void place(File& file, const Placements& placements, std::vector<glm::dvec3> mesh_origins,
           Scene& scene) {
    const std::vector<Extent> boxes = boxes_of(scene, mesh_origins);
    SceneExtent extent;
    for (const Placement& placement : placements.meshes) {
        extent.add(transformed(boxes[placement.index], placement.to_world));
        add_details(scene.meshes[placement.index], mesh_origins[placement.index],
                    placement.to_world, placements.meshes.size(), extent);
    }
    scene.origin = origin_of(extent);
    centre_meshes(placements.meshes, boxes, mesh_origins, scene);
    scene.names.resize(file.document.nodes.size());
    for (const Placement& placement : placements.meshes)
        scene.instances.push_back(
            {placement.index,
             recounted(placement.to_world, mesh_origins[placement.index], scene.origin),
             name_of(placement, file.document, scene)});
    for (const Placement& placement : placements.cameras)
        add_camera(file, placement, recounted(placement.to_world, glm::dvec3(0.0), scene.origin),
                   scene);
    for (const Placement& placement : placements.lights)
        add_light(file, placement, recounted(placement.to_world, glm::dvec3(0.0), scene.origin),
                  scene);
}

} // namespace onde::gltf
