#include "session/device_group.h"

#include "core/error.h"
#include "film/region.h"

#include <algorithm>
#include <set>
#include <thread>

namespace onde {

DeviceGroup::DeviceGroup(std::vector<std::unique_ptr<Session>> sessions,
                         std::function<void(const std::string&)> on_lost)
    : sessions_(std::move(sessions)), on_lost_(std::move(on_lost)), is_lost_(sessions_.size()) {
    const RenderOptions& options = session().options();
    if (size() > 1) check_units(options, "several devices");
    if (size() > 1 && options.seconds > 0)
        throw InputError("a time limit is for one device; name one, or say how many samples");
}

void DeviceGroup::set_camera(const Camera& camera) {
    for (size_t i = 0; i < size(); i++)
        if (!is_lost_[i]) sessions_[i]->set_camera(camera);
    work_.reset();
}

void DeviceGroup::set_environment_rotation(float radians) {
    for (size_t i = 0; i < size(); i++)
        if (!is_lost_[i]) sessions_[i]->set_environment_rotation(radians);
    work_.reset();
}

void DeviceGroup::set_next_view(const Camera& camera, float environment_rotation) {
    for (size_t i = 0; i < size(); i++)
        if (!is_lost_[i]) sessions_[i]->set_next_view(camera, environment_rotation);
    work_.reset();
}

void DeviceGroup::lose(size_t device, const std::string& why) {
    const std::lock_guard lock(losing_);
    is_lost_[device] = true;
    const auto works = std::ranges::find(is_lost_, false);
    if (works == is_lost_.end()) throw DeviceError(why);
    first_ = size_t(works - is_lost_.begin());
    on_lost_(why);
}

gpu::BuildReport DeviceGroup::prepare() {
    if (size() == 1) return session().prepare();
    for (size_t i = 0; i < size(); i++) {
        if (is_lost_[i]) continue;
        try {
            sessions_[i]->prepare();
        } catch (const DeviceError& error) {
            lose(i, error.what());
        }
    }
    return session().prepare();
}

RenderOutcome DeviceGroup::render(const KeepGoing& keep_going) {
    return size() == 1 ? session().render(keep_going) : render_together(keep_going);
}

Rectangle DeviceGroup::window() const {
    const RenderOptions& options = session().options();
    return options.rectangle.value_or(Rectangle{0, 0, options.width, options.height});
}

bool DeviceGroup::finish_block(const KeepGoing& keep_going) {
    const FilmExtent extent = session().film().extent();
    if (extent.end % FILM_BLOCK == 0 && extent.pixels == 0) return true;
    const RenderOptions picture = session().options();
    RenderOptions block = picture;
    block.samples = std::min(picture.samples, (extent.end / FILM_BLOCK + 1) * FILM_BLOCK);
    session().set_options(block);
    const RenderOutcome outcome = session().render([&](Progress progress) {
        progress.target_samples = picture.samples - picture.first_sample;
        progress.fraction = progress.samples / progress.target_samples;
        return !keep_going || keep_going(progress);
    });
    session().set_options(picture);
    return !outcome.interrupted;
}

/// Of the picture, so that there are enough units for shares by speed, and waves are full.
uint32_t DeviceGroup::bands(uint32_t blocks) const {
    constexpr uint32_t UNITS_A_DEVICE = 8;
    uint64_t most = window().height;
    for (const auto& session : sessions_) {
        const RenderOptions& options = session->options();
        most = std::min(most,
                        window().pixels() * options.samples_in_flight / options.settings.wave_size);
    }
    const uint64_t wanted = (UNITS_A_DEVICE * size() + blocks - 1) / blocks;
    return uint32_t(std::clamp<uint64_t>(wanted, 1, std::max<uint64_t>(most, 1)));
}

std::vector<FilmUnit> DeviceGroup::units() const {
    const RenderOptions& picture = session().options();
    const uint32_t begin = session().film().extent().end;
    const uint32_t rows = bands((picture.samples - begin + FILM_BLOCK - 1) / FILM_BLOCK);
    std::vector<FilmUnit> units;
    for (uint32_t first = begin; first < picture.samples; first += FILM_BLOCK)
        for (uint32_t band = 0; band < rows; band++)
            units.push_back({tile_of(window(), 1, rows, band), first,
                             std::min(first + FILM_BLOCK, picture.samples)});
    return units;
}

RenderOutcome DeviceGroup::render_together(const KeepGoing& keep_going) {
    constexpr double PAUSE = 0.2; // seconds between two reports
    const Timer timer;
    prepare();
    const bool goes_on = finish_block(keep_going);
    const Film& film = session().film();
    if (!goes_on || film.extent().end >= session().options().samples)
        return {timer.seconds(), film.samples(), !goes_on};
    pictures_.clear();
    for (const auto& session : sessions_) pictures_.push_back(session->options());
    const auto working = size_t(std::ranges::count(is_lost_, false));
    work_.reset(new Work{UnitQueue(units(), working),
                         SharedFilm(film.contents(), pictures_[first_], window(), size())});
    works_ = true;
    std::vector<std::thread> threads;
    for (size_t device = 0; device < size(); device++)
        if (!is_lost_[device]) threads.emplace_back([this, device] { take_units(device); });
    while (!work_->queue.wait_for_all(PAUSE))
        if (keep_going && !keep_going(work_->film.progress())) work_->queue.stop();
    for (std::thread& thread : threads) thread.join();
    works_ = false;
    if (work_->failure) std::rethrow_exception(work_->failure);
    put_film(work_->film.contents());
    if (keep_going) keep_going(work_->film.progress());
    return {timer.seconds(), samples(), work_->queue.has_left_over()};
}

void DeviceGroup::take_units(size_t device) {
    UnitQueue& queue = work_->queue;
    bool works = true;
    while (works) {
        const auto unit = queue.take();
        if (!unit) break;
        bool is_done = false;
        try {
            is_done = render_unit(device, *unit);
        } catch (...) {
            work_->film.drop(device);
            note_failure(device);
            works = false;
        }
        if (is_done)
            queue.finish();
        else
            queue.give_back(*unit);
    }
    queue.leave();
}

bool DeviceGroup::render_unit(size_t device, const FilmUnit& unit) {
    Session& session = *sessions_[device];
    begin_unit(session, pictures_[device], unit);
    const RenderOutcome outcome = session.render([&](const Progress& progress) {
        work_->film.tell(device, unit, progress);
        return !work_->queue.is_stopped();
    });
    if (!outcome.interrupted) work_->film.add(device, unit, session);
    return !outcome.interrupted;
}

void DeviceGroup::note_failure(size_t device) {
    try {
        try {
            throw;
        } catch (const DeviceError& error) {
            lose(device, error.what());
        }
    } catch (...) {
        const std::lock_guard lock(losing_);
        if (!work_->failure) work_->failure = std::current_exception();
        work_->queue.stop();
    }
}

void DeviceGroup::put_film(const FilmContents& contents) {
    for (;;) try {
            for (size_t i = 0; i < size(); i++)
                if (!is_lost_[i]) sessions_[i]->set_options(pictures_[i]);
            session().clear();
            session().film().restore(contents);
            return;
        } catch (const DeviceError& error) {
            lose(first_, error.what());
        }
}

FilmContents DeviceGroup::contents() const {
    return works_ ? work_->film.contents() : session().film().contents();
}

double DeviceGroup::samples() const {
    return works_ ? work_->film.samples() : session().film().samples();
}

FilmHeader DeviceGroup::film_header() const {
    FilmHeader header = session().film_header();
    std::set<std::string> classes;
    for (const auto& session : sessions_) classes.insert(device_class(session->device().facts()));
    header.maker.device_class = fmt::format("{}", fmt::join(classes, " and "));
    return header;
}

void DeviceGroup::restore_film(const KeptFilm& kept) {
    check_same(kept.header, film_header());
    KeptFilm own = kept;
    own.header = session().film_header(); // whose class may be one of several
    session().restore_film(own);
}

RayCounts DeviceGroup::ray_counts() const {
    return work_ ? work_->film.ray_counts() : session().ray_counts();
}

Film::Invalid DeviceGroup::find_invalid() const {
    return work_ ? work_->film.invalid() : session().film().find_invalid();
}

std::map<std::string, gpu::KernelTime> DeviceGroup::kernel_times() const {
    std::map<std::string, gpu::KernelTime> all;
    for (const auto& session : sessions_)
        for (const auto& [kernel, time] : session->kernel_times()) {
            all[kernel].launches += time.launches;
            all[kernel].seconds += time.seconds;
        }
    return all;
}

std::vector<DeviceShare> DeviceGroup::shares() const {
    std::vector<DeviceShare> shares;
    for (size_t i = 0; work_ && i < size(); i++) {
        shares.push_back(work_->film.share(i));
        shares.back().device = sessions_[i]->device().facts().name;
        shares.back().is_lost = is_lost_[i];
    }
    return shares;
}

} // namespace onde
