// The ranks of an MPI job. Nothing else of the program knows MPI, which is built in where it is
// found.
#pragma once

#include "farm/ranks.h"

#include <memory>

namespace onde {

/// Joins the job that mpirun started. Throws InputError where MPI is not built in.
std::unique_ptr<Ranks> join_mpi_job();

} // namespace onde
