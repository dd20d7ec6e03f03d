// A picture by the ranks of a job. Units of the picture, by number, go round: rank r renders r,
// r + R, ... of R. The sums of a node of the film's tree lie at the rank that rendered its first
// unit; where both halves are there, the right one travels to the left. What is done lies as files
// in a store too, so that a job whose ranks died goes on from there, with any number of ranks.
#pragma once

#include "farm/ranks.h"
#include "farm/work.h"

#include <map>
#include <set>

namespace onde {

class RankWork {
  public:
    /// Throws InputError where the store is another picture's.
    RankWork(Ranks& ranks, const Store& store, WorkPlan plan, Worker::Render render);

    /// Renders this rank's units. The film, whose sums rank 0 alone has; nothing where it was
    /// interrupted. Throws InputError for files in the store that are not of this film.
    std::optional<KeptFilm> run();

    uint64_t rendered() const { return rendered_; } ///< units, by this rank

  private:
    uint32_t owner(const StoreKey& node) const;
    FilmRange range(const StoreKey& node) const;
    size_t sum_count(const StoreKey& node) const;
    std::optional<StoreKey> done_before(uint32_t tile, uint32_t index) const;

    bool do_unit(uint32_t tile, uint32_t index);
    void join(const StoreKey& right);
    FilmSums take(const StoreKey& node);
    FilmSums load(const StoreKey& node) const;
    void save(const StoreKey& node, const FilmSums& sums) const;
    FilmSums gather(const FilmNode& node, const FilmContents& film);
    KeptFilm gather();

    Ranks& ranks_;
    const Store& store_;
    WorkPlan plan_;
    Worker::Render render_;
    std::set<StoreKey> before_;         ///< that an earlier job has done
    std::map<StoreKey, FilmSums> held_; ///< by this rank: rows, each plane after plane
    uint64_t rendered_ = 0;
};

/// The plan for a store in which so many ranks are to work: as it was begun there with as many
/// samples, else with enough units for all, of at least so many pixels.
WorkPlan plan_for_ranks(const Store& store, const FilmHeader& header, uint32_t ranks,
                        uint64_t pixels);

} // namespace onde
