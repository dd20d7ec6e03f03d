#include "support/chapter/eye.h"

namespace onde::chapter {

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

dvec2 r2_sample(uint32_t index) {
    const auto fraction = [](uint32_t bits) { return double(bits >> 8) / (1 << 24); };
    return {fraction(0x80000000u + index * 0xC13FA9A9u),
            fraction(0x80000000u + index * 0x91E10DA6u)};
}

Ray camera_ray(const Camera& camera, glm::uvec2 size, const dvec2& film) {
    const dvec2 pixels(size);
    const dvec2 centred(film.x / pixels.x - 0.5, 0.5 - film.y / pixels.y);
    dvec3 origin(0), direction(0, 0, -1);
    if (camera.screen) {
        const dvec2 window(camera.screen->size);
        dvec2 e = centred * window;
        if (camera.screen->first_pixel) {
            const dvec2 ij(film.x - 0.5, pixels.y - 0.5 - film.y);
            e = dvec2(*camera.screen->first_pixel) + ij * window / pixels;
        }
        direction = dvec3(e, -double(camera.screen->distance));
    } else if (camera.orthographic_height) {
        const double height = double(*camera.orthographic_height);
        origin = dvec3(centred.x * height * pixels.x / pixels.y, centred.y * height, 0);
    } else {
        const double half = std::tan(0.5 * double(camera.vertical_fov));
        direction = dvec3(2 * half * centred.x * pixels.x / pixels.y, 2 * half * centred.y, -1);
    }
    const glm::dmat4 to_world(camera.camera_to_world);
    return {dvec3(to_world * dvec4(origin, 1)),
            glm::normalize(dvec3(to_world * dvec4(direction, 0)))};
}

} // namespace onde::chapter
