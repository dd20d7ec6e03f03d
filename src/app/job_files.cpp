#include "app/job_files.h"

#include "core/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace onde::app {
namespace {

constexpr uint32_t BLOCK = 64; ///< samples

/// Between single quotes of a shell.
std::string quoted(const std::string& text) {
    return "'" + text + "'";
}

std::string worker_command(const JobText& job) {
    return fmt::format("onde work {} {} --spp {}{}{}", quoted(job.folder + "/store"),
                       quoted(job.scene), job.samples, job.options.empty() ? "" : " ", job.options);
}

} // namespace

void check_job(const JobText& job) {
    for (const std::string& text : {job.scene, job.folder, job.options, job.image})
        if (std::ranges::any_of(text, [](char c) {
                return c == '\'' || c == '"' || c == '\\' || c == '{' || c == '}' || c == '$' ||
                       c == '`' || static_cast<unsigned char>(c) < ' ';
            }))
            throw InputError("{}: quotes, braces, $ and \\ can't stand in a job file; rename it",
                             text);
}

std::string slurm_job(const JobText& job) {
    return fmt::format(R"JOB(#!/bin/bash
# Written by onde farm slurm. Submit it with: sbatch {folder}/job.sh
# The film is {folder}/store/film.exr in the end; onde farm status {folder}/store tells how far it is.
#SBATCH --job-name=onde
#SBATCH --array=0-{last}
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output="{folder}/worker-%a.log"
#SBATCH --signal=B:TERM@60
set -u
{command} &
worker=$!
trap 'kill -TERM "$worker" 2>/dev/null' TERM # the lease is given back
wait "$worker"
code=$?
[ "$code" -le 128 ] || {{ wait "$worker"; code=$?; }}
exit "$code"
)JOB",
                       fmt::arg("folder", job.folder), fmt::arg("last", job.workers - 1),
                       fmt::arg("command", worker_command(job)));
}

std::string openjd_template(const JobText& job) {
    const uint32_t blocks = (job.samples + BLOCK - 1) / BLOCK;
    return fmt::format(R"JOB(# Written by onde farm openjd.
specificationVersion: jobtemplate-2023-09
extensions: [TASK_CHUNKING]
name: onde
parameterDefinitions:
  - name: Scene
    type: STRING
    default: '{scene}'
  - name: Out
    type: STRING
    default: '{folder}'
  - name: BlocksPerTask
    type: INT
    default: {chunk}
    minValue: 1
steps:
  - name: render
    parameterSpace:
      taskParameterDefinitions:
        - name: Block
          type: CHUNK[INT]
          range: "0-{last}"
          chunks:
            defaultTaskCount: "{{{{Param.BlocksPerTask}}}}"
            rangeConstraint: CONTIGUOUS
    script:
      actions:
        onRun:
          command: bash
          args: ["{{{{Task.File.Run}}}}"]
      embeddedFiles:
        - name: Run
          type: TEXT
          data: |
            set -euo pipefail
            blocks='{{{{Task.Param.Block}}}}' # "first-last", also of a single one
            first=$((${{blocks%-*}} * {block}))
            end=$(((${{blocks#*-}} + 1) * {block}))
            [ $end -le {samples} ] || end={samples}
            mkdir -p '{{{{Param.Out}}}}/parts'
            film='{{{{Param.Out}}}}'/parts/$first-$end.exr
            echo "openjd_status: samples $first to $((end - 1))"
            onde render '{{{{Param.Scene}}}}' --spp {samples} {options} \
                --samples $first:$end --film "$film" --resume "$film" --checkpoint 60
  - name: merge
    dependencies:
      - dependsOn: render
    script:
      actions:
        onRun:
          command: onde
          args: ["merge", "{{{{Param.Out}}}}/parts", "--complete", "-o", "{{{{Param.Out}}}}/film.exr", "--picture", "{{{{Param.Out}}}}/picture.png"]
)JOB",
                       fmt::arg("scene", job.scene), fmt::arg("folder", job.folder),
                       fmt::arg("chunk", std::max(1u, blocks / (4 * job.workers))),
                       fmt::arg("last", blocks - 1), fmt::arg("block", BLOCK),
                       fmt::arg("samples", job.samples), fmt::arg("options", job.options));
}

std::string kubernetes_job(const JobText& job) {
    return fmt::format(
        R"JOB(# Written by onde farm kubernetes. Submit it with: kubectl apply -f job.yaml
# {folder} has to be a volume that all pods mount; it is taken from each node here.
apiVersion: batch/v1
kind: Job
metadata:
  name: onde
spec:
  completionMode: Indexed
  completions: {workers}
  parallelism: {workers}
  backoffLimit: 1000000
  podFailurePolicy:
    rules:
      - action: FailJob # wrong input, or bits that differ
        onExitCodes:
          containerName: onde
          operator: In
          values: [2]
      - action: Ignore # the pod was moved
        onPodConditions:
          - type: DisruptionTarget
  template:
    spec:
      restartPolicy: Never
      terminationGracePeriodSeconds: 60
      containers:
        - name: onde
          image: '{image}'
          command: ["bash", "-c", "exec {command}"]
          volumeMounts:
            - name: store
              mountPath: '{folder}'
      volumes:
        - name: store
          hostPath:
            path: '{folder}'
)JOB",
        fmt::arg("folder", job.folder), fmt::arg("workers", job.workers),
        fmt::arg("image", job.image), fmt::arg("command", worker_command(job)));
}

} // namespace onde::app
