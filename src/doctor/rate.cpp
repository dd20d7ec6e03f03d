// How fast the device renders the built-in scene.
#include "doctor/built_in_scene.h"
#include "doctor/checks.h"
#include "doctor/pictures.h"

#include <fmt/format.h>

namespace onde::doctor {

Finding check_rate(const CheckContext& context) {
    RenderOptions options = picture_options(context, 320, 240, 1u << 16);
    options.settings = gpu::default_settings(context.facts());
    options.seconds = context.quick ? 1 : 5;
    Session session(context.programs, built_in_scene(), session_options(context, options));
    session.prepare();
    const RenderOutcome outcome = session.render();
    const double rays = double(session.ray_counts().total()) / outcome.seconds;
    const double samples = outcome.samples * options.width * options.height / outcome.seconds;
    return {.passed = rays > 0,
            .value = rays * 1e-6,
            .unit = "Mrays/s",
            .text = fmt::format("{:.3g} million samples/s of 320x240 pixels in {:.1f} s",
                                samples * 1e-6, outcome.seconds)};
}

} // namespace onde::doctor
