#include "app/picture.h"

#include "core/log.h"

namespace onde::app {

void tell_kernels(const Session& session, const gpu::BuildReport& kernels, size_t devices) {
    const std::string others = devices > 1 ? fmt::format(" (one of {} devices)", devices) : "";
    spdlog::info("rendering {}x{} on {}{}, kernels {} in {:.2f} s", session.options().width,
                 session.options().height, session.device().facts().name, others,
                 kernels.from_cache ? "loaded" : "compiled", kernels.seconds);
}

ShownPicture shown_picture(Session& session, Outputs& outputs) {
    ShownPicture shown;
    if (session.has_denoiser())
        outputs.attempt([&] {
            DenoisedImage denoised = session.denoised();
            shown = {std::move(denoised.picture), session.picture(), std::move(denoised.groups),
                     std::move(denoised.denoiser), denoised.seconds};
            spdlog::info("denoised by {} in {:.2f} s", shown.denoiser, shown.seconds);
        });
    if (!shown.denoiser.empty()) return shown;
    shown.picture = session.picture();
    shown.groups = session.light_groups();
    return shown;
}

ImageMetadata picture_metadata(const Session& session, const std::string& hash,
                               const RenderOutcome& outcome) {
    return {{"onde:scene_hash", hash},
            {"onde:seed", std::to_string(session.options().seed)},
            {"onde:samples", fmt::format("{:.6g}", outcome.samples)},
            {"onde:device", session.device().facts().name},
            {"onde:version", ONDE_VERSION},
            {"Software", "Onde " ONDE_VERSION}};
}

Display requested_display(const Session& session, const RenderRequest& request) {
    Display display = display_of(session.scene().settings, session.options().integrator);
    display.exposure = request.exposure.value_or(display.exposure);
    display.tone_map = request.tone_map.value_or(display.tone_map);
    return display;
}

} // namespace onde::app
