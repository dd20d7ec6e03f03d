// `onde farm`: the job files for schedulers run as they are.
#include "onde_process.h"
#include "support/folders.h"

using namespace onde::test;

namespace {

void run(const Folder& folder, const Arguments& arguments) {
    const Outcome outcome = onde::test::onde(folder, arguments);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
}

const Arguments PICTURE{"--spp", "200", "--with", "--size 24x16 --lanes 8 --quiet"};

Arguments job(const std::string& scheduler, const Arguments& more = PICTURE) {
    Arguments all{"farm", scheduler, CORNELL, "-o", "job"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

/// As nodes of a cluster run it, where onde is on the path.
int run_twice_at_once(const Folder& folder, const std::string& script) {
    const std::string path = fs::path(built_program()).parent_path();
    return std::system(("cd " + folder.path().string() + " && export PATH=" + path +
                        ":$PATH ONDE_CACHE_DIR=" + test_cache_folder().string() + " && { bash " +
                        script + " & other=$!; bash " + script + " && wait $other; }")
                           .c_str());
}

} // namespace

TEST_CASE("the script for Slurm is a worker, of which any number make one film") {
    const Folder folder;
    run(folder, job("slurm"));
    CHECK_THAT(content(folder / "job/job.sh"), Catch::Contains("#SBATCH --array=0-3\n") &&
                                                   Catch::Contains("#SBATCH --requeue\n") &&
                                                   Catch::Contains("#SBATCH --open-mode=append\n"));
    CHECK_THAT(content(folder / "job/job.sh"), // also of a name with a space
               Catch::Contains("#SBATCH --output=\"" + (folder / "job").string()));
    CHECK(run_twice_at_once(folder, "job/job.sh") == 0);
    run(folder, {"render", CORNELL, "--spp", "200", "--size", "24x16", "--film", "whole.exr"});
    CHECK(content(folder / "job/store/film.exr") == content(folder / "whole.exr"));
}

TEST_CASE("the files for other schedulers name what is to be run") {
    const Folder folder;
    run(folder, job("openjd"));
    CHECK_THAT(content(folder / "job/template.yaml"),
               Catch::Contains("type: CHUNK[INT]\n          range: \"0-3\"\n") &&
                   Catch::Contains("[ $end -le 200 ] || end=200\n") &&
                   Catch::Contains("onde render '{{Param.Scene}}' --spp 200 --size 24x16 ") &&
                   Catch::Contains("parts\", \"--complete\", \"-o\""));
    run(folder, job("kubernetes"));
    CHECK_THAT(content(folder / "job/job.yaml"),
               Catch::Contains("completionMode: Indexed\n") && Catch::Contains("values: [2]\n") &&
                   Catch::Contains("exec onde work '" + (folder / "job/store").string() + "'"));
}

TEST_CASE("names that a job file would not take as they are, are refused") {
    const Folder folder;
    const Outcome outcome =
        onde::test::onde(folder, job("slurm", {"--spp", "4", "--with", "--camera \"a'b\""}));
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Catch::Contains("can't stand in a job file"));
    CHECK_FALSE(fs::exists(folder / "job/job.sh"));
}
