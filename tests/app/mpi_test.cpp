// `onde render --mpi`: the ranks of a job make the film and the picture of one render, also after
// one of them was killed.
#include "onde_process.h"

#include <iterator>
#include <sstream>

using namespace onde::test;

namespace {

Arguments picture(const std::string& spp, const Arguments& more) {
    Arguments all{"--spp", spp, "--wave-size", "512", "--aov", "albedo", "--quiet"};
    all.insert(all.end(), more.begin(), more.end());
    return render(CORNELL, all);
}

Arguments mpirun(int ranks) {
    return {"timeout",
            "-k",
            "2",
            "300",
            "mpirun",
            "--oversubscribe",
            "--allow-run-as-root",
            "-n",
            std::to_string(ranks)};
}

Outcome run(const Folder& folder, int ranks, const Arguments& arguments) {
    return Process(folder, arguments, {}, mpirun(ranks)).wait();
}

/// Processes that this one has started.
std::vector<pid_t> children(pid_t pid) {
    const std::string of = std::to_string(pid);
    std::istringstream list(content("/proc/" + of + "/task/" + of + "/children"));
    return {std::istream_iterator<pid_t>(list), {}};
}

/// Of a job that mpirun started, which timeout started.
std::vector<pid_t> ranks_of(const Process& job) {
    const std::vector<pid_t> launched = children(job.pid());
    return launched.empty() ? launched : children(launched.front());
}

void check_refused(const Folder& folder, const Arguments& arguments, const std::string& words) {
    const Outcome outcome = onde::test::onde(folder, arguments);
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Catch::Contains(words));
}

} // namespace

TEST_CASE("an onde without MPI says what to install") {
    if (ONDE_HAS_MPI) return;
    const Folder folder;
    check_refused(folder, picture("1", {"--mpi"}), "install the Debian packages openmpi-bin");
}

TEST_CASE("two, four and eight ranks make the film and the picture of one render") {
    if (!ONDE_HAS_MPI) return;
    const Folder folder;
    for (const std::string spp : {"20", "300"}) { // bands of a block, and blocks
        const std::string one = "one" + spp;
        REQUIRE(onde::test::onde(folder, picture(spp, {"--film", one + ".film.exr", "-o",
                                                       one + ".exr", "-o", one + ".png"}))
                    .code == 0);
        for (const int ranks : {2, 4, 8}) {
            const std::string name = "ranks" + spp + "-" + std::to_string(ranks);
            const Outcome outcome = run(folder, ranks,
                                        picture(spp, {"--mpi", "--film", name + ".film.exr", "-o",
                                                      name + ".exr", "-o", name + ".png"}));
            INFO(outcome.err);
            REQUIRE(outcome.code == 0);
            for (const char* file : {".film.exr", ".exr", ".png", ".albedo.png"})
                CHECK(content(folder / (one + file)) == content(folder / (name + file)));
            CHECK_FALSE(fs::exists(folder / (name + ".film.exr.parts")));
        }
    }
}

TEST_CASE("a job whose rank was killed goes on from its parts, by another number of ranks") {
    if (!ONDE_HAS_MPI) return;
    const Folder folder;
    const std::string spp = "20000";
    REQUIRE(onde::test::onde(folder, picture(spp, {"--film", "one.exr"})).code == 0);
    const Arguments with_parts = picture(spp, {"--mpi", "--film", "all.exr", "--parts", "parts"});
    Process job(folder, with_parts, {}, mpirun(4));
    for (int i = 0; i < 6000 && !fs::exists(folder / "parts/t0000-l02-i000000.exr"); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const std::vector<pid_t> ranks = ranks_of(job);
    REQUIRE(ranks.size() == 4);
    kill(ranks[2], SIGKILL);
    CHECK(job.wait().code != 0);
    CHECK_FALSE(fs::exists(folder / "all.exr"));
    REQUIRE(fs::exists(folder / "parts"));
    const Outcome other =
        run(folder, 2,
            picture(spp, {"--mpi", "--seed", "9", "--film", "other.exr", "--parts", "parts"}));
    CHECK(other.code == 2);
    CHECK_THAT(other.err, Catch::Contains("this film is of another seed"));
    const Outcome outcome = run(folder, 3, with_parts);
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(content(folder / "all.exr") == content(folder / "one.exr"));
    CHECK_FALSE(fs::exists(folder / "parts"));
}

TEST_CASE("what lies in the folder of parts and is none stays") {
    if (!ONDE_HAS_MPI) return;
    const Folder folder;
    fs::create_directories(folder / "parts/notes");
    folder.write("parts/notes/diary.txt", "dear diary");
    const Outcome outcome =
        run(folder, 2, picture("128", {"--mpi", "--film", "all.exr", "--parts", "parts"}));
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(content(folder / "parts/notes/diary.txt") == "dear diary");
    CHECK_FALSE(fs::exists(folder / "parts/leases"));
}

TEST_CASE("what ranks can't do together is said in one sentence") {
    const Folder folder;
    check_refused(folder, picture("1", {"--mpi", "--time", "1"}), "leave out --resume");
    check_refused(folder, picture("1", {"--mpi", "--turntable", "2"}), "--mpi is of one picture");
    check_refused(folder, picture("1", {"--mpi", "-o", "-"}), "can't go to standard output");
    check_refused(folder, picture("1", {"--parts", "x"}), "--parts is of --mpi");
    if (ONDE_HAS_MPI)
        check_refused(folder, render(CORNELL, {"--mpi", "--integrator", "light"}),
                      "light has none");
}
