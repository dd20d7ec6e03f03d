#include "app/turntable.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

namespace onde::app {

Camera turned_camera(const Camera& camera, const SceneBounds& bounds, double radians) {
    const glm::dvec3 middle = 0.5 * (glm::dvec3(bounds.low) + glm::dvec3(bounds.high));
    const glm::dmat4 there = glm::translate(glm::dmat4(1.0), middle);
    const glm::dmat4 turn = glm::rotate(there, radians, glm::dvec3(0, 1, 0));
    Camera turned = camera;
    turned.camera_to_world =
        glm::mat4(glm::translate(turn, -middle) * glm::dmat4(camera.camera_to_world));
    return turned;
}

std::filesystem::path numbered_path(const std::filesystem::path& output, uint32_t number) {
    std::filesystem::path path = output;
    return path.replace_extension(fmt::format("{:04}{}", number, output.extension().string()));
}

} // namespace onde::app
