#include "session/unit_queue.h"

namespace onde {

UnitQueue::UnitQueue(const std::vector<FilmUnit>& units, size_t threads)
    : waiting_(units.begin(), units.end()), threads_(threads) {}

std::optional<FilmUnit> UnitQueue::take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return stopped_ || !waiting_.empty() || taken_ == 0; });
    if (stopped_ || waiting_.empty()) return std::nullopt;
    const FilmUnit unit = waiting_.front();
    waiting_.pop_front();
    taken_++;
    return unit;
}

void UnitQueue::finish() {
    const std::lock_guard lock(mutex_);
    taken_--;
    changed_.notify_all();
}

void UnitQueue::give_back(const FilmUnit& unit) {
    const std::lock_guard lock(mutex_);
    waiting_.push_front(unit);
    taken_--;
    changed_.notify_all();
}

void UnitQueue::stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    changed_.notify_all();
}

bool UnitQueue::is_stopped() const {
    const std::lock_guard lock(mutex_);
    return stopped_;
}

void UnitQueue::leave() {
    const std::lock_guard lock(mutex_);
    threads_--;
    changed_.notify_all();
}

bool UnitQueue::wait_for_all(double seconds) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::duration<double>(seconds),
                             [&] { return threads_ == 0; });
}

bool UnitQueue::has_left_over() const {
    const std::lock_guard lock(mutex_);
    return !waiting_.empty();
}

} // namespace onde
