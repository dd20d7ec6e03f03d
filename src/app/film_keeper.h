// The film file of a picture that is being rendered: gone on from, written now and then, and at the
// end.
#pragma once

#include "app/sequence.h"
#include "core/abandoned.h"
#include "core/timer.h"

#include <future>
#include <optional>

namespace onde::app {

/// Throws InputError, before anything is compiled, for a film of another picture, a damaged one,
/// and for integrators without samples of single pixels.
void check_film(const DeviceGroup& devices, const Shot& shot);

class FilmKeeper {
  public:
    /// Without a film file, nothing is kept. Goes on from the shot's film, where there is one.
    /// Throws InputError for a film of another picture, and for integrators without samples of
    /// single pixels.
    FilmKeeper(DeviceGroup& devices, const Shot& shot, std::optional<double> seconds);

    /// Writes the film where the time for it has come, beside the render. What fails is told once.
    void keep_if_due();
    /// Writes the film. Throws InputError.
    void keep();

  private:
    /// So that another render that goes on from the film leaves it; false where one has it.
    bool hold_film();
    /// Before the first write: a film that another render has made or goes on from is left.
    void take_place();
    void write();
    void write_beside();
    /// Of the write that runs, if one does.
    void wait();

    DeviceGroup& devices_;
    const Shot& shot_;
    std::filesystem::path path_; ///< of the film
    Descriptor held_;            ///< what is there
    bool has_place_;             ///< which is this render's
    std::optional<double> seconds_;
    KeptFilm film_{};                  ///< as it is written
    std::future<std::string> writing_; ///< what became of it; empty: it is well
    bool told_ = false;
    Timer since_;
};

} // namespace onde::app
