// The options of films: what to render of a picture, which files to write and to go on from.
#pragma once

#include "app/sequence.h"

namespace onde::app {

/// Throws InputError for values that are wrong whatever the scene is.
void check_film_request(const RenderRequest& request);

/// Nothing where all are asked for. Throws InputError.
std::optional<std::pair<uint32_t, uint32_t>> requested_samples(const RenderRequest& request);
std::optional<Rectangle> requested_rectangle(const RenderRequest& request);

/// The film file that is written; empty: none.
std::filesystem::path film_path(const RenderRequest& request);

/// Gives each picture its film files, numbered as its pictures are. Throws InputError where one
/// can't be written, or holds a film that would be lost.
void place_films(std::vector<Shot>& shots, const RenderRequest& request);

} // namespace onde::app
