#include "session/film_unit.h"

#include "core/error.h"

namespace onde {

void check_units(const RenderOptions& picture, const char* who) {
    if (!follows_pixels(picture.integrator))
        throw InputError("{} share out samples of single pixels, by --integrator path or whitted; "
                         "{} has none",
                         who, word_of(picture.integrator));
    if (picture.noise > 0)
        throw InputError("{} share out the samples of a picture, and --noise decides as it goes "
                         "which those are; leave it out (--noise 0)",
                         who);
}

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
