#include "doctor/pictures.h"

#include "doctor/built_in_picture.h"
#include "doctor/built_in_scene.h"
#include "upload/layout_choice.h"
#include "upload/pack.h"

namespace onde::doctor {

RenderOptions picture_options(const CheckContext& context, uint32_t width, uint32_t height,
                              uint32_t samples) {
    RenderOptions options;
    options.width = width;
    options.height = height;
    options.samples = samples;
    options.filter = Filter::box;
    options.settings = gpu::default_settings(context.facts());
    options.settings.wave_size = std::min(options.settings.wave_size, 1u << 16); // small pictures
    return options;
}

RenderOptions built_in_options(const CheckContext& context) {
    return picture_options(context, BUILT_IN_WIDTH, BUILT_IN_HEIGHT, 16);
}

SessionOptions session_options(const CheckContext& context, const RenderOptions& render,
                               std::optional<BvhLayout> layout) {
    SessionOptions options{.render = render};
    options.bvh.layout = layout.value_or(known_layout(context.facts()));
    options.choose_layout = false;
    SceneFeatures features = pack_scene(built_in_scene(), options.bvh).features;
    features.rough_glass = true; // furnaces have some
    options.features = features;
    return options;
}

Image picture_of(const CheckContext& context, const Scene& scene, const RenderOptions& render,
                 std::optional<BvhLayout> layout) {
    Session session(context.programs, scene, session_options(context, render, layout));
    session.render();
    return session.picture();
}

} // namespace onde::doctor
