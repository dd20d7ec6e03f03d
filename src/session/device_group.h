// Sessions of one scene, each on a device of its own, that render one picture together. They take
// units of it from one queue, so that each has a share by its speed; a device that fails gives its
// unit back. As blocks of samples are joined by the one tree, the picture has the bits that one of
// the devices would give it, if all are of one class (film/identity.h).
#pragma once

#include "session/shared_film.h"
#include "session/unit_queue.h"

#include <exception>
#include <map>
#include <memory>

namespace onde {

class DeviceGroup {
  public:
    using KeepGoing = std::function<bool(const Progress&)>;

    /// At least one session; several have equal scenes and options, but for what is the device's.
    /// Throws InputError for several whose integrator's samples are not each of one pixel, or that
    /// are limited by their time. `on_lost` is told, on any thread, of a device that failed while
    /// others go on.
    DeviceGroup(std::vector<std::unique_ptr<Session>> sessions,
                std::function<void(const std::string&)> on_lost);

    size_t size() const { return sessions_.size(); }
    /// That which has the film before and after a render, on a device that works.
    Session& session() const { return *sessions_.at(first_); }

    void set_camera(const Camera& camera);
    void set_environment_rotation(float radians);
    void set_next_view(const Camera& camera, float environment_rotation);
    /// As Session::prepare(), on all devices; the report of the first.
    gpu::BuildReport prepare();

    /// As Session::render(). When several are stopped, the film keeps its blocks of 64 samples that
    /// all pixels have. Throws DeviceError when no device is left.
    RenderOutcome render(const KeepGoing& keep_going = {});

    // As of a Session, of all devices; the first two within `keep_going` too.

    FilmContents contents() const;
    double samples() const; ///< per pixel
    FilmHeader film_header() const;
    void restore_film(const KeptFilm& kept);
    RayCounts ray_counts() const;
    Film::Invalid find_invalid() const;
    std::map<std::string, gpu::KernelTime> kernel_times() const;

    /// Of the last render by several devices; empty for one.
    std::vector<DeviceShare> shares() const;

  private:
    /// A render of several: what its threads share.
    struct Work {
        UnitQueue queue;
        SharedFilm film;
        std::exception_ptr failure{}; ///< that no other device can help
    };

    RenderOutcome render_together(const KeepGoing& keep_going);
    /// A block that was begun ends on one device; false where it was stopped.
    bool finish_block(const KeepGoing& keep_going);
    std::vector<FilmUnit> units() const;
    uint32_t bands(uint32_t blocks) const;
    Rectangle window() const;
    /// Renders units until there are no more, on a thread of the device's own.
    void take_units(size_t device);
    bool render_unit(size_t device, const FilmUnit& unit);
    /// Whatever was thrown: whether the device takes no more.
    void note_failure(size_t device);
    /// The device fails while others are left; else throws DeviceError.
    void lose(size_t device, const std::string& why);
    /// The film goes to a session that works.
    void put_film(const FilmContents& contents);

    std::vector<std::unique_ptr<Session>> sessions_;
    std::vector<RenderOptions> pictures_; ///< by session: the options of the whole picture
    std::function<void(const std::string&)> on_lost_;
    std::mutex losing_;
    std::vector<bool> is_lost_; ///< by session
    size_t first_ = 0;          ///< session that is not lost
    std::unique_ptr<Work> work_;
    bool works_ = false; ///< now
};

} // namespace onde
