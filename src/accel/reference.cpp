#include "accel/reference.h"

#include "accel/parallel.h"

namespace onde::accel {

namespace {

void fill_references(const Geometry& geometry, uint32_t owner, std::span<Reference> out,
                     bool parallel) {
    const size_t triangles = geometry.triangles.size();
    for_each_index(out.size(), parallel, [&](size_t i) {
        const auto index = uint32_t(i);
        out[i] = i < triangles
                     ? Reference(triangle_box(geometry, index), owner, index)
                     : Reference(single_box(geometry, index), owner | Reference::SINGLE, index);
    });
}

} // namespace

Box triangle_box(const Geometry& geometry, uint32_t triangle) {
    const glm::uvec3 corners = geometry.triangles[triangle];
    Box box;
    for (glm::length_t corner = 0; corner < 3; ++corner)
        box.extend(lanes(geometry.positions[corners[corner]]));
    return box;
}

Box sphere_box(const SphereInput& sphere) {
    return {lanes(sphere.center - sphere.radius), lanes(sphere.center + sphere.radius)};
}

Box shape_box(const ShapeInput& shape) {
    const float r = shape.minor_radius;
    switch (shape.kind) {
    case SHAPE_DISK:
        return {Lanes{-1, 0, -1, 0}, Lanes{1, 0, 1, 0}};
    case SHAPE_CONE:
        return {Lanes{-1, 0, -1, 0}, Lanes{1, 1, 1, 0}};
    case SHAPE_TORUS:
        return {Lanes{-1 - r, -r, -1 - r, 0}, Lanes{1 + r, r, 1 + r, 0}};
    default:
        return {Lanes{-1, -1, -1, 0}, Lanes{1, 1, 1, 0}};
    }
}

Box single_box(const Geometry& geometry, uint32_t index) {
    const size_t sphere = index - geometry.triangles.size();
    if (sphere < geometry.spheres.size()) return sphere_box(geometry.spheres[sphere]);
    return shape_box(geometry.shapes[sphere - geometry.spheres.size()]);
}

std::vector<Reference> make_references(std::span<const Geometry> geometries,
                                       std::span<const uint32_t> owners, bool parallel) {
    size_t count = 0;
    for (uint32_t owner : owners) count += geometries[owner].size();

    std::vector<Reference> references(count);
    size_t first = 0;
    for (uint32_t owner : owners) {
        const Geometry& geometry = geometries[owner];
        const size_t size = geometry.size();
        fill_references(geometry, owner, std::span(references).subspan(first, size), parallel);
        first += size;
    }
    return references;
}

} // namespace onde::accel
