#include "session/film_unit.h"

namespace onde {

void begin_unit(Session& session, const RenderOptions& picture, const FilmUnit& unit) {
    RenderOptions options = picture;
    options.first_sample = unit.first;
    options.samples = unit.end;
    options.picture_samples =
        picture.picture_samples > 0 ? picture.picture_samples : picture.samples;
    options.rectangle = unit.window;
    session.set_options(options);
    session.clear();
}

} // namespace onde
