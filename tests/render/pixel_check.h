// What the depth buffer must show, by a rasteriser in double precision that shares nothing with it.
#pragma once

#include "scene/scene.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace onde::test {

struct Fragment {
    double depth;
    uint32_t material;
};

/// What one pixel's centre sees, in double precision; nothing where rounding may decide.
class PixelCheck {
  public:
    PixelCheck(const Scene& scene, uint32_t width, uint32_t height)
        : scene_(scene), height_(height), width_(width),
          pixel_(double(*scene.cameras[0].orthographic_height) / height) {}

    std::optional<glm::vec3> color(uint32_t x, uint32_t y) {
        place_ = {(x + 0.5 - width_ / 2.0) * pixel_, (height_ / 2.0 - y - 0.5) * pixel_};
        fragments_.clear();
        doubtful_ = false;
        for (const Instance& instance : scene_.instances) judge(instance);
        for (const Sphere& sphere : scene_.spheres) judge(sphere);
        std::ranges::sort(fragments_, {}, &Fragment::depth);
        if (fragments_.size() > 1)
            doubtful_ |= fragments_[1].depth - fragments_[0].depth < 1e-5 &&
                         fragments_[1].material != fragments_[0].material;
        if (doubtful_) return std::nullopt;
        if (fragments_.empty()) return *scene_.chapter.whitted.background;
        return scene_.materials[fragments_[0].material].base_color;
    }

  private:
    static double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

    double distance_to_edge(glm::dvec2 a, glm::dvec2 b) const {
        const glm::dvec2 edge = b - a;
        const double length2 = std::max(glm::dot(edge, edge), 1e-30);
        const double along = std::clamp(glm::dot(place_ - a, edge) / length2, 0.0, 1.0);
        return glm::length(place_ - a - along * edge);
    }

    void judge(const Instance& instance) {
        const Mesh& mesh = scene_.meshes[instance.mesh];
        for (size_t i = 0; i < mesh.triangles.size(); i++) {
            glm::dvec2 p[3];
            double z[3];
            for (uint32_t k = 0; k < 3; k++) {
                const glm::dvec4 corner(mesh.positions[mesh.triangles[i][k]], 1);
                const glm::dvec4 placed = glm::dmat4(instance.object_to_world) * corner;
                p[k] = glm::dvec2(placed);
                z[k] = placed.z;
            }
            for (int k = 0; k < 3; k++) // corners are rounded to 1/256 of a pixel
                doubtful_ |= distance_to_edge(p[k], p[(k + 1) % 3]) < pixel_ / 256;
            const double area = cross(p[1] - p[0], p[2] - p[0]);
            const double b = cross(place_ - p[0], p[2] - p[0]) / area;
            const double c = cross(p[1] - p[0], place_ - p[0]) / area;
            if (!(b >= 0 && c >= 0 && b + c <= 1)) continue;
            add(10 - (z[0] + b * (z[1] - z[0]) + c * (z[2] - z[0])), mesh.materials[i]);
        }
    }

    void judge(const Sphere& sphere) {
        const double r = sphere.radius;
        const double d = glm::length(place_ - glm::dvec2(sphere.center));
        doubtful_ |= std::abs(d - r) < pixel_ / 256;
        if (d >= r) return;
        const double half = std::sqrt(r * r - d * d);
        add(10 - sphere.center.z - half, sphere.material);
        add(10 - sphere.center.z + half, sphere.material);
    }

    void add(double depth, uint32_t material) {
        if (depth > 0) fragments_.push_back({depth, material});
    }

    const Scene& scene_;
    uint32_t height_, width_;
    double pixel_;
    glm::dvec2 place_{0};
    std::vector<Fragment> fragments_;
    bool doubtful_ = false;
};

} // namespace onde::test
