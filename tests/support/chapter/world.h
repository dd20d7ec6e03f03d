// A scene's geometry in double precision, searched one by one.
#pragma once

#include "support/chapter/solids.h"

#include <vector>

namespace onde::chapter {

/// A point on a surface, with the unit normal on the side that the ray came from.
struct Surface {
    double t = 0;
    glm::dvec3 point{0}, normal{0};
    bool front = true; ///< the ray came from the surface's front
    uint32_t material = 0;
    uint32_t primitive = 0; ///< as numbered by World; the halves of a rectangle differ
};

class World {
  public:
    /// Throws std::invalid_argument for meshes with smooth normals, which the chapter lacks.
    explicit World(const Scene& scene);

    /// The first surface in front of the ray, whose direction is unit.
    std::optional<Surface> nearest(const Ray& ray) const;

    /// What is left of light along the ray up to that distance: a factor `transmission` of the
    /// material for each surface crossed. `crossings` is the number of those, if any light is left.
    double transmitted(const Ray& ray, double distance, const Scene& scene,
                       uint32_t& crossings) const;

  private:
    struct Triangle {
        glm::dvec3 corners[3];
        glm::dvec3 front;
        uint32_t material;
    };
    struct Solid {
        ShapeKind kind;
        double minor_radius;
        uint32_t material;
        glm::dmat4 to_object;
        glm::dvec3 centre; ///< of a ball around it
        double radius;
    };
    template <class Visit>
    void visit_crossings(const Ray& ray, double low, double high, const Visit& visit) const;
    void add_instance(const Mesh& mesh, const glm::dmat4& to_world);
    void add_solid(ShapeKind kind, double minor_radius, uint32_t material,
                   const glm::dmat4& to_world);

    std::vector<Triangle> triangles_;
    std::vector<Solid> solids_;
};

} // namespace onde::chapter
