// Processes of one job that pass sums to each other, by their ranks: what a picture by many
// processes needs of MPI. src/mpi has it where MPI is built in.
#pragma once

#include "render/film_contents.h"

#include <string>

namespace onde {

class Ranks {
  public:
    virtual ~Ranks() = default;

    virtual uint32_t rank() const = 0;
    virtual uint32_t count() const = 0;
    /// Among those of the same machine.
    virtual uint32_t local_rank() const = 0;

    /// Returns at once, or when what was sent before has arrived. Sums arrive in their order.
    virtual void send(uint32_t to, FilmSums sums) = 0;
    /// Waits for so many sums.
    virtual FilmSums receive(uint32_t from, size_t count) = 0;
    /// Rank 0's text, for all.
    virtual std::string broadcast(const std::string& text) = 0;
    /// All are done. A rank that ends without it ends the others too.
    virtual void finish() = 0;
};

} // namespace onde
