// Where a picture is seen from.
#pragma once

#include "core/enum_words.h"
#include "scene/fields.h"

#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>

#include <optional>
#include <string>

namespace onde {

/// A window of real size at a distance before the eye (the chapter's screen, C3).
struct ScreenWindow {
    glm::vec2 size{1.0f};                 ///< a, b, world units
    float distance = 1.0f;                ///< f
    std::optional<glm::vec2> first_pixel; ///< centre of the lower left pixel, from the view axis;
                                          ///< else the window is centred on the axis
};

constexpr auto fields_of(TypeTag<ScreenWindow>) {
    using S = ScreenWindow;
    return std::tuple{
        field("size", &S::size, "width and height", {.range = POSITIVE, .required = true}),
        field("distance", &S::distance, "from the eye", {.range = POSITIVE, .required = true}),
        field("first_pixel", &S::first_pixel, "centre of the lower left pixel, from the view axis",
              {.absent = "centred"})};
}

/// How directions become places of the picture.
enum class Projection : uint32_t {
    rectilinear, ///< straight lines stay straight, or rays are parallel
    panorama,    ///< the whole sphere, equirectangular
    fisheye,     ///< equidistant, in the largest circle of the picture
};

constexpr auto enum_words(Projection) {
    return std::array{EnumWord{Projection::rectilinear, "rectilinear"},
                      EnumWord{Projection::panorama, "panorama"},
                      EnumWord{Projection::fisheye, "fisheye"}};
}

struct Camera {
    std::string name;
    glm::mat4 camera_to_world{1.0f};            ///< rotation and translation
    float vertical_fov = 0.7f;                  ///< radians
    float aperture_radius = 0.0f;               ///< thin lens; 0 is a pinhole
    uint32_t aperture_blades = 0;               ///< corners of the lens; 0: it is round
    float aperture_rotation = 0.0f;             ///< radians, of its first corner from the right
    float focus_distance = 1.0f;                ///< along the view axis
    std::optional<float> orthographic_height{}; ///< of the view: parallel rays, else a perspective
    std::optional<float> aspect_ratio{};        ///< width over height that is seen at the least
    std::optional<ScreenWindow> screen{};       ///< replaces vertical_fov
    Projection projection = Projection::rectilinear; ///< what is not is seen from a point
    float fisheye_angle = glm::pi<float>();          ///< radians, across the circle
};

/// Whether it sees more than a plane shows.
inline bool is_wide(const Camera& camera) {
    return camera.projection != Projection::rectilinear;
}

constexpr auto fields_of(TypeTag<Camera>) {
    using C = Camera;
    return std::tuple{
        field("name", &C::name, ""),
        LoaderKey{"position", "`[x, y, z]`", "", "required"},
        LoaderKey{"look_at", "`[x, y, z]`", "a point that differs from `position`", "required"},
        LoaderKey{"up", "`[x, y, z]`", "not parallel to the view axis", "`[0, 1, 0]`"},
        field_without_key(&C::camera_to_world, "transform"),
        field("vertical_fov", &C::vertical_fov, "the angle of view",
              {.range = {.low = 1e-4, .high = 179.99}, .form = Form::degrees, .absent = "`40`"}),
        field("aperture", &C::aperture_radius, "radius of the thin lens; 0 is a pinhole",
              {.range = NOT_NEGATIVE, .form = Form::length}),
        field("aperture_blades", &C::aperture_blades,
              "of the lens, whose corners lie on that radius; 0 is a round one",
              {.range = {.low = 0, .high = 100}}),
        field("aperture_rotation", &C::aperture_rotation,
              "of the first corner from the right, counter-clockwise as the camera sees it",
              {.form = Form::degrees}),
        field("focus_distance", &C::focus_distance, "along the view axis",
              {.range = POSITIVE, .form = Form::length, .absent = "the distance to `look_at`"}),
        field("orthographic_height", &C::orthographic_height,
              "of the view in world units; parallel rays instead of `vertical_fov`",
              {.range = POSITIVE, .form = Form::length, .absent = "a perspective"}),
        field("aspect_ratio", &C::aspect_ratio,
              "width over height of a view that narrower pictures show whole, by seeing more above "
              "and below",
              {.range = POSITIVE, .absent = "the picture's"}),
        field("screen", &C::screen, "a window before the eye instead of `vertical_fov`"),
        field(
            "projection", &C::projection,
            "how directions become places of the picture: `\"panorama\"` shows the whole sphere, "
            "its middle along the view axis, `\"fisheye\"` a circle in which angles from the axis "
            "are lengths; both see from a point, without a lens"),
        field("fisheye_angle", &C::fisheye_angle, "of view of a fisheye, across its circle",
              {.range = {.low = 1, .high = 360}, .form = Form::degrees, .absent = "`180`"}),
        LoaderKey{"motion", "tables", "where it is in time, see [motion](#motion)", "none"}};
}

} // namespace onde
