// Of a build without MPI.
#include "mpi/mpi_ranks.h"

#include "core/error.h"

namespace onde {

std::unique_ptr<Ranks> join_mpi_job() {
    throw InputError("--mpi: this onde was built without MPI; install the Debian packages "
                     "openmpi-bin and libopenmpi-dev, remove the folder build/onde and build it "
                     "again");
}

} // namespace onde
