#include "app/unit_renderer.h"

#include "core/error.h"
#include "core/timer.h"
#include "session/film_unit.h"

namespace onde::app {

UnitRenderer::UnitRenderer(Session& session, const RenderRequest& request,
                           const StopOnInterrupt& interrupt)
    : session_(session), request_(request), interrupt_(interrupt), picture_(session.options()),
      header_(session.film_header()) {
    check_units(picture_, "workers");
}

bool UnitRenderer::render(const Rectangle& window, std::pair<uint32_t, uint32_t> samples,
                          const std::filesystem::path& file, const std::function<void()>& renew) {
    constexpr double RENEWED_AFTER = 2; // seconds
    begin_unit(session_, picture_, {window, samples.first, samples.second});
    Timer since;
    const std::string name = fmt::format("samples {} to {}", samples.first, samples.second - 1);
    const auto meanwhile = [&] {
        if (since.seconds() < RENEWED_AFTER) return;
        renew();
        since = Timer();
    };
    const RenderOutcome outcome =
        render_until_done(session_, name, interrupt_, request_.quiet, meanwhile);
    if (outcome.interrupted) return false;
    write_film(file, {header_, window, session_.film().contents()});
    return true;
}

} // namespace onde::app
