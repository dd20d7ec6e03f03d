// Job files for schedulers, as text: what they are to run is `onde work`, or parts and their merge.
#pragma once

#include <cstdint>
#include <string>

namespace onde::app {

struct JobText {
    std::string scene, folder; ///< absolute
    std::string options;       ///< of the render
    std::string image = "onde";
    uint32_t samples = 0, workers = 4;
};

/// Throws InputError for names that a shell or YAML would not take as they are.
void check_job(const JobText& job);

/// A script for sbatch: an array whose tasks are workers, started again where a node fails.
std::string slurm_job(const JobText& job);

/// A template of Open Job Description with the extension TASK_CHUNKING: chunks of blocks of 64
/// samples, then the merge.
std::string openjd_template(const JobText& job);

/// An indexed Job whose pods are workers. Wrong input is not tried again.
std::string kubernetes_job(const JobText& job);

} // namespace onde::app
