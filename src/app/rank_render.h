// `onde render --mpi`: one picture by the ranks of an MPI job.
#pragma once

#include "app/interrupt.h"
#include "app/sequence.h"
#include "farm/ranks.h"

namespace onde::app {

/// Throws InputError for options that ranks can't share.
void check_mpi_request(const RenderRequest& request);

/// The folder of the job's parts: --parts, else beside its first output.
std::filesystem::path parts_folder(const RenderRequest& request);

/// Of the devices that the request names, the one of this rank.
Machines open_machine_of_rank(const RenderRequest& request, const Ranks& ranks);

/// Renders the units of this rank; the session of rank 0 gets the whole film. Returns whether it
/// was interrupted.
bool render_by_ranks(Session& session, const RenderRequest& request, Ranks& ranks,
                     const StopOnInterrupt& interrupt);

/// What is in the folder of parts, once the outputs are written.
void remove_parts(const RenderRequest& request);

} // namespace onde::app
