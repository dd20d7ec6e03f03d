// The film of a picture whose units several threads render: what they have done so far.
#pragma once

#include "film/assembly.h"
#include "session/film_unit.h"

#include "core/timer.h"

#include <mutex>

namespace onde {

/// What a device has done of a picture.
struct DeviceShare {
    std::string device;
    double share = 0; ///< of the samples
    uint32_t units = 0;
    bool is_lost = false; ///< it failed
};

class SharedFilm {
  public:
    /// Goes on from `begun`, of whole blocks, to the last of the options' samples.
    SharedFilm(FilmContents begun, const RenderOptions& picture, const Rectangle& window,
               size_t devices);

    /// A device is at a unit, or no longer (of which nothing is kept).
    void tell(size_t device, const FilmUnit& unit, const Progress& progress);
    void drop(size_t device);
    /// The unit that the session's film has is done.
    void add(size_t device, const FilmUnit& unit, Session& session);

    FilmContents contents() const;
    double samples() const; ///< per pixel
    Progress progress() const;

    // Of units that are done.

    RayCounts ray_counts() const { return rays_; }
    Film::Invalid invalid() const { return invalid_; }
    /// Its share of the samples, and how many units.
    DeviceShare share(size_t device) const;

  private:
    struct Doing {
        double done = 0, current = 0; ///< samples, those of all pixels counted
        double rays_per_second = 0;
        uint32_t units = 0;
    };

    mutable std::mutex mutex_;
    FilmAssembly assembly_;
    double pixels_;
    uint32_t before_, target_; ///< samples of each pixel
    std::vector<Doing> doing_; ///< by device
    RayCounts rays_;
    Film::Invalid invalid_;
    Timer timer_;
};

} // namespace onde
