// Units of a picture that several threads take, each as often as it can.
#pragma once

#include "session/film_unit.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

namespace onde {

class UnitQueue {
  public:
    /// Of so many threads, each of which leaves in the end.
    UnitQueue(const std::vector<FilmUnit>& units, size_t threads);

    /// The first one that nobody has. Waits while another thread may give one back; nothing when
    /// all are done, or when it was stopped.
    std::optional<FilmUnit> take();
    /// What was taken is done,
    void finish();
    /// or goes back in front of the others.
    void give_back(const FilmUnit& unit);
    /// Nothing more is handed out.
    void stop();
    bool is_stopped() const;

    void leave();
    /// Waits until all threads have left, but no longer than that; whether they have.
    bool wait_for_all(double seconds);

    /// Whether some are not done.
    bool has_left_over() const;

  private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<FilmUnit> waiting_;
    size_t taken_ = 0, threads_;
    bool stopped_ = false;
};

} // namespace onde
