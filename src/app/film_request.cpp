#include "app/film_request.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/output.h"

#include <cmath>

namespace onde::app {
namespace {

namespace fs = std::filesystem;

void check_film_path(const fs::path& film) {
    if (is_standard_output(film) || !is_exr(film))
        throw InputError("{}: a film file is an .exr; change the extension", film.string());
}

/// Where one picture's film is written, and gone on from if it is there.
void place_film(Shot& shot, const RenderRequest& request) {
    const auto placed = [&](const fs::path& path) {
        return path.empty() || !is_sequence(request) ? path : numbered_path(path, shot.number);
    };
    shot.film = placed(film_path(request));
    shot.resume = placed(request.resume);
    std::error_code ignored;
    const bool resumes = !shot.resume.empty() && is_same_file(shot.film, shot.resume);
    if (fs::exists(shot.film, ignored) && !resumes)
        throw InputError("{}: is there already; go on from it with --resume, or name another file",
                         shot.film.string());
    if (!shot.resume.empty() && !fs::exists(shot.resume, ignored)) {
        if (request.film.empty() && !is_sequence(request))
            throw InputError("{}: there is no such film to go on from; check the name",
                             shot.resume.string());
        shot.resume.clear(); // a job that is started again and again
    }
}

} // namespace

fs::path film_path(const RenderRequest& request) {
    return request.film.empty() ? request.resume : request.film;
}

void check_film_request(const RenderRequest& r) {
    for (const fs::path& path : {r.film, r.resume})
        if (!path.empty()) check_film_path(path);
    if (r.checkpoint && film_path(r).empty())
        throw InputError("--checkpoint needs a film file to write; name one with --film");
    if (r.checkpoint && !(*r.checkpoint > 0 && std::isfinite(*r.checkpoint)))
        throw InputError("--checkpoint {} is not a positive number of seconds", *r.checkpoint);
    requested_samples(r);
    requested_rectangle(r);
}

std::optional<std::pair<uint32_t, uint32_t>> requested_samples(const RenderRequest& request) {
    if (request.sample_range.empty()) return std::nullopt;
    if (const auto range = parse_pair(request.sample_range, ':', "--samples")) return range;
    throw InputError("--samples {} is not of the form FIRST:END, for example 64:128",
                     request.sample_range);
}

std::optional<Rectangle> requested_rectangle(const RenderRequest& request) {
    const std::string& text = request.rectangle;
    if (text.empty()) return std::nullopt;
    const size_t middle = text.find(',', text.find(',') + 1);
    if (middle != std::string::npos) {
        const std::string_view all = text;
        const auto corner = parse_pair(all.substr(0, middle), ',', "--rectangle");
        const auto size = parse_pair(all.substr(middle + 1), ',', "--rectangle");
        if (corner && size)
            return Rectangle{corner->first, corner->second, size->first, size->second};
    }
    throw InputError("--rectangle {} is not of the form X,Y,WIDTH,HEIGHT, for example 0,0,64,64",
                     text);
}

void place_films(std::vector<Shot>& shots, const RenderRequest& request) {
    if (film_path(request).empty()) return;
    WritableCheck writable;
    for (Shot& shot : shots) {
        place_film(shot, request);
        writable.check(shot.film);
        std::vector<fs::path> others = shot.outputs;
        if (!request.json.empty()) others.push_back(request.json);
        for (const fs::path& other : others)
            if (is_same_file(other, shot.film))
                throw InputError("{}: a film and what else is written cannot go to the same place; "
                                 "name another",
                                 other.string());
    }
}

} // namespace onde::app
