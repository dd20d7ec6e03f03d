// A worker's part of a picture that many share by a store: it renders what is missing, joins pairs
// that are complete, and ends when the film is. There is no server: all is in the store.
#pragma once

#include "farm/store.h"

#include <functional>

namespace onde {

/// How a picture is cut.
struct WorkPlan {
    FilmHeader header;
    uint32_t unit_samples = FILM_BLOCK; ///< a power of two of blocks
    uint32_t columns = 1, rows = 1;     ///< of tiles

    uint32_t tiles() const { return columns * rows; }
    uint32_t units() const; ///< of a tile
    Rectangle window(uint32_t tile) const;
    /// The samples of a unit: the first, and the one behind the last.
    std::pair<uint32_t, uint32_t> samples(uint32_t index) const;
};

/// Notes in the store how its picture is cut. Throws InputError for a cut that does not fit the
/// picture, or the one that the store was begun with.
void begin_plan(const Store& store, const WorkPlan& plan);

/// How the picture of a store is cut; nothing where no worker has begun.
struct BegunPlan {
    uint32_t samples = 0, unit_samples = 0, columns = 0, rows = 0;
};
std::optional<BegunPlan> begun_plan(const Store& store);

class Worker {
  public:
    /// Writes the film of a unit's samples to a file; false when it was interrupted. Calls `renew`
    /// now and then.
    using Render =
        std::function<bool(const Rectangle& window, std::pair<uint32_t, uint32_t> samples,
                           const std::filesystem::path& file, const std::function<void()>& renew)>;

    /// `verify` is the share of units that are rendered twice and compared.
    Worker(const Store& store, WorkPlan plan, double verify, Render render);

    enum class Step {
        worked,  ///< something was done
        waiting, ///< others are at what is left
        done,    ///< the film is complete
        interrupted,
    };
    /// Does the next thing that there is to do. Throws InputError where two renders of a unit
    /// differ, or the store is another picture's.
    Step step();

    uint64_t rendered() const { return rendered_; } ///< units, by this worker
    uint64_t joined() const { return joined_; }     ///< pairs

  private:
    bool is_verified(uint32_t tile, uint32_t index) const;
    std::optional<Step> join_pair(const std::vector<StoreKey>& keys);
    std::optional<Step> render_missing(const std::vector<StoreKey>& keys);
    std::optional<Step> verify_unit();
    Step finish(const std::vector<StoreKey>& keys);
    Step render_unit(const StoreKey& key, const std::string& lease);

    const Store& store_;
    WorkPlan plan_;
    double verify_;
    Render render_;
    bool has_missing_ = false; ///< units, when it was looked last
    uint64_t rendered_ = 0, joined_ = 0;
};

/// How far the work in a store is.
struct WorkState {
    uint32_t units = 0, done = 0; ///< of all tiles
    uint32_t workers = 0;         ///< that hold leases now
    double seconds_a_unit = 0;    ///< on average; 0 before the first
    bool complete = false;        ///< the film is there
};

/// Throws InputError for a folder in which no worker has begun.
WorkState work_state(const Store& store);

} // namespace onde
