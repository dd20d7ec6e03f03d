// Small scenes made in code, for tests that have a closed form.
#pragma once

#include "scene/scene.h"

namespace onde::reference {

/// A pinhole camera at `eye` that looks at `target`; the up vector is +Y, or -Z along the Y axis.
Camera look_at(const glm::vec3& eye, const glm::vec3& target, float vertical_fov);

/// The parallelogram p, p + a, p + a + b, p + b of two triangles with front normal a x b; uv run
/// along a and b.
Mesh parallelogram(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, uint32_t material);

/// Adds the mesh and one instance of it; returns the index of the mesh.
uint32_t add_mesh(Scene& scene, Mesh mesh, const glm::mat4& object_to_world = glm::mat4(1.0f));

Material diffuse(const glm::vec3& albedo);
Material conductor(const glm::vec3& reflectance, float roughness);
Material glass(float ior, float roughness);
/// Black but for its light, which leaves the front face only.
Material emitter(const glm::vec3& radiance);

/// A sphere of radius 1 at the origin in a white furnace of radiance 1, filling the image.
Scene furnace(const Material& material);

/// A 2 x 2 x 2 box around the origin, open to the viewer: white walls with a red and a green one,
/// a square light under the ceiling, a sphere of `material` on the floor.
Scene box_room(const Material& material);

} // namespace onde::reference
