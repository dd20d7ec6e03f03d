// A picture on its way to a file, by whatever command.
#pragma once

#include "app/interrupt.h"
#include "app/progress_line.h"
#include "app/render_request.h"
#include "core/output.h"

namespace onde::app {

/// Says which device renders, of how many, and what became of its kernels.
void tell_kernels(const Session& session, const gpu::BuildReport& kernels, size_t devices = 1);

/// Renders by a Session or a DeviceGroup until the picture is done or an interrupt is requested;
/// the progress is shown after `name`, where there is one. Calls `meanwhile` a few times a second,
/// between waves.
template <class Renderer>
RenderOutcome render_until_done(Renderer& renderer, const std::string& name,
                                const StopOnInterrupt& interrupt, bool quiet,
                                const std::function<void()>& meanwhile = {}) {
    ProgressLine line(quiet, name);
    const RenderOutcome outcome = renderer.render([&](const Progress& progress) {
        line.show(progress);
        if (meanwhile) meanwhile();
        return !interrupt.requested();
    });
    line.finish();
    return outcome;
}

/// What a session shows, by the denoiser where its options ask for one.
struct ShownPicture {
    Image picture{}, noisy{};    ///< the latter where there is a denoiser
    std::vector<Image> groups{}; ///< the light of groups of lights, where the film has it
    std::string denoiser{};      ///< its name, or empty
    double seconds = 0;          ///< that it took
};

/// A denoiser that fails costs no picture: it has its noise then, and `outputs` keep the sentence.
ShownPicture shown_picture(Session& session, Outputs& outputs);

/// What a file of the session's picture says about it. `hash` is that of the scene.
ImageMetadata picture_metadata(const Session& session, const std::string& hash,
                               const RenderOutcome& outcome);

/// How light is shown: as the request says, else as the scene does.
Display requested_display(const Session& session, const RenderRequest& request);

} // namespace onde::app
