#include "app/film_keeper.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"

#include <fcntl.h>

namespace onde::app {

void check_film(const DeviceGroup& devices, const Shot& shot) {
    if (shot.film.empty()) return;
    const RenderOptions& options = devices.session().options();
    if (!follows_pixels(options.integrator))
        throw InputError("--film is for --integrator path and whitted, whose samples are each of "
                         "one pixel; {} has none to go on with",
                         word_of(options.integrator));
    if (shot.resume.empty()) return;
    FilmReader film(shot.resume);
    check_same(film.header(), devices.film_header(), shot.resume.string());
    for (size_t part = 0; part < film.parts().size(); part++) film.check_part(part);
}

FilmKeeper::FilmKeeper(DeviceGroup& devices, const Shot& shot, std::optional<double> seconds)
    : devices_(devices), shot_(shot), path_(shot.film),
      has_place_(!shot.resume.empty() && is_same_file(shot.resume, shot.film) && hold_film()),
      seconds_(seconds) {
    if (shot.film.empty()) return;
    const RenderOptions& options = devices.session().options();
    film_.header = devices.film_header();
    film_.window = options.rectangle.value_or(Rectangle{0, 0, options.width, options.height});
    if (shot.resume.empty()) return;
    const KeptFilm kept = read_film(shot.resume, film_.header);
    film_.header.samples = std::max(film_.header.samples, kept.header.samples);
    devices.restore_film(kept);
    spdlog::info("going on from {:.4g} samples per pixel of {}", devices.samples(),
                 shot.resume.string());
}

void FilmKeeper::wait() {
    if (!writing_.valid()) return;
    const std::string failure = writing_.get();
    if (failure.empty() || told_) return;
    spdlog::warn("{}; the render goes on", failure);
    told_ = true;
}

bool FilmKeeper::hold_film() {
    constexpr int ACCESS = O_RDWR | O_CLOEXEC; // NFS locks what can be written
    held_ = Descriptor(open(path_.c_str(), ACCESS));
    return !held_ || try_hold(held_);
}

void FilmKeeper::write() {
    write_film(path_, film_);
    hold_film();
}

void FilmKeeper::take_place() {
    std::error_code ignored;
    if (!has_place_ && std::filesystem::exists(path_, ignored)) {
        const std::filesystem::path wanted = path_;
        for (int number = 2; std::filesystem::exists(path_, ignored); number++)
            path_.replace_filename(fmt::format("{}.{}.exr", wanted.stem().string(), number));
        spdlog::warn("{}: another render makes it or goes on from it; this film goes to {}",
                     wanted.string(), path_.string());
    }
    has_place_ = true;
}

void FilmKeeper::write_beside() {
    take_place();
    film_.contents = devices_.contents();
    writing_ = std::async(std::launch::async, [this]() -> std::string {
        try {
            write();
            return {};
        } catch (const std::exception& error) {
            return error.what();
        }
    });
}

void FilmKeeper::keep_if_due() {
    if (shot_.film.empty() || !seconds_ || since_.seconds() < *seconds_) return;
    constexpr auto AT_ONCE = std::chrono::seconds(0);
    if (writing_.valid() && writing_.wait_for(AT_ONCE) != std::future_status::ready) return;
    wait();
    if (devices_.samples() > 0) write_beside();
    since_ = Timer();
}

void FilmKeeper::keep() {
    if (writing_.valid()) writing_.get(); // what it failed of, this one will
    if (shot_.film.empty() || devices_.samples() == 0) return;
    take_place();
    film_.contents = devices_.contents();
    write();
    spdlog::info("wrote {}", std::filesystem::absolute(path_).string());
}

} // namespace onde::app
