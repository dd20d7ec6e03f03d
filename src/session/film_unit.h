// A unit of a picture's work: some of its samples of some of its pixels, in a session of its own or
// one after the other in the same.
#pragma once

#include "session/session.h"

namespace onde {

struct FilmUnit {
    Rectangle window;
    uint32_t first = 0, end = 0; ///< samples, from a multiple of 64 on

    uint64_t pixel_samples() const { return window.pixels() * (end - first); }
};

/// Throws InputError for a picture that can't be had in units. `who` are to share them out.
void check_units(const RenderOptions& picture, const char* who);

/// The session's film becomes an empty one of just the unit; what it renders next are the unit's
/// samples. `picture` are the options of the whole.
void begin_unit(Session& session, const RenderOptions& picture, const FilmUnit& unit);

} // namespace onde
