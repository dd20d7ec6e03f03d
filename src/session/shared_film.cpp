#include "session/shared_film.h"

#include <algorithm>

namespace onde {

static void add_counts(std::vector<uint64_t>& counts, const std::vector<uint64_t>& more) {
    if (counts.size() < more.size()) counts.resize(more.size());
    for (size_t i = 0; i < more.size(); i++) counts[i] += more[i];
}

SharedFilm::SharedFilm(FilmContents begun, const RenderOptions& picture, const Rectangle& window,
                       size_t devices)
    : assembly_(std::move(begun), window), pixels_(double(window.pixels())),
      before_(assembly_.contents().extent.end - picture.first_sample),
      target_(picture.samples - picture.first_sample), doing_(devices) {}

void SharedFilm::tell(size_t device, const FilmUnit& unit, const Progress& progress) {
    const std::lock_guard lock(mutex_);
    doing_[device].current = double(unit.pixel_samples()) * progress.fraction;
    doing_[device].rays_per_second = progress.rays_per_second;
}

void SharedFilm::drop(size_t device) {
    const std::lock_guard lock(mutex_);
    doing_[device].current = doing_[device].rays_per_second = 0;
}

void SharedFilm::add(size_t device, const FilmUnit& unit, Session& session) {
    const FilmContents contents = session.film().contents();
    const RayCounts rays = session.ray_counts();
    const Film::Invalid invalid = session.film().find_invalid();
    const std::lock_guard lock(mutex_);
    assembly_.add(unit.window, contents);
    Doing& doing = doing_[device];
    doing.done += double(unit.pixel_samples());
    doing.current = 0;
    doing.units++;
    add_counts(rays_.extension, rays.extension);
    add_counts(rays_.shadow, rays.shadow);
    const uint32_t before = invalid_.count;
    if (before == 0) invalid_ = invalid;
    invalid_.count = before + invalid.count;
}

FilmContents SharedFilm::contents() const {
    const std::lock_guard lock(mutex_);
    return assembly_.contents();
}

double SharedFilm::samples() const {
    const std::lock_guard lock(mutex_);
    const FilmExtent& extent = assembly_.contents().extent;
    return extent.end - extent.begin;
}

Progress SharedFilm::progress() const {
    const std::lock_guard lock(mutex_);
    double here = 0; // samples per pixel
    Progress progress;
    for (const Doing& doing : doing_) {
        here += (doing.done + doing.current) / pixels_;
        progress.rays_per_second += doing.rays_per_second;
    }
    progress.samples = before_ + here;
    progress.target_samples = target_;
    progress.fraction = std::min(1.0, progress.samples / target_);
    progress.seconds = timer_.seconds();
    progress.seconds_left = progress.seconds * (target_ - progress.samples) / std::max(here, 1e-9);
    return progress;
}

DeviceShare SharedFilm::share(size_t device) const {
    double all = 0;
    for (const Doing& doing : doing_) all += doing.done;
    return {.device = {},
            .share = all > 0 ? doing_[device].done / all : 0,
            .units = doing_[device].units};
}

} // namespace onde
