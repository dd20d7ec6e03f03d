// `onde work`: workers that share a folder make the film of one render, whatever becomes of them.
#include "onde_process.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <memory>
#include <random>

using namespace onde::test;

namespace {

Arguments picture(const Arguments& first, const Arguments& more = {}) {
    Arguments all = first;
    all.insert(all.end(), {CORNELL, "--lanes", "8", "--size", "40x30", "--spp", "300", "--quiet"});
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

void check_ends_well(const Outcome& outcome) {
    INFO(outcome.err);
    CHECK(outcome.code == 0);
}

} // namespace

TEST_CASE("workers that share a folder make the film and the picture of one render") {
    const Folder folder;
    check_ends_well(
        onde::test::onde(folder, picture({"render"}, {"--film", "whole.exr", "-o", "whole.png"})));
    for (const Arguments& cut : {Arguments{"--unit", "128"}, {"--tiles", "2x2"}}) {
        fs::remove_all(folder / "store");
        Arguments more = cut;
        more.insert(more.end(), {"-o", "a.png"});
        Process one(folder, picture({"work", "store"}, cut));
        Process two(folder, picture({"work", "store"}, cut));
        check_ends_well(onde::test::onde(folder, picture({"work", "store"}, more)));
        check_ends_well(one.wait());
        check_ends_well(two.wait());
        CHECK(content(folder / "store/film.exr") == content(folder / "whole.exr"));
        CHECK(content(folder / "a.png") == content(folder / "whole.png"));
        CHECK(fs::is_empty(folder / "store/leases"));
        const auto status =
            nlohmann::json::parse(output_of(folder, {"farm", "status", "store", "--json"}));
        CHECK(status.at("complete") == true);
        CHECK(status.at("left") == 0);
        CHECK(status.at("units") == (cut.front() == "--unit" ? 3 : 20));
    }
}

TEST_CASE("one, two, three and eight workers make the same bytes") {
    const Folder folder;
    check_ends_well(onde::test::onde(folder, picture({"render"}, {"--film", "whole.exr"})));
    for (const int count : {1, 2, 3, 8}) {
        const std::string store = "store" + std::to_string(count);
        const Arguments worker = picture({"work", store}, {"--tiles", "2x1"});
        std::vector<std::unique_ptr<Process>> workers;
        for (int i = 0; i < count; i++)
            workers.push_back(std::make_unique<Process>(folder, worker));
        for (const auto& each : workers) check_ends_well(each->wait());
        CHECK(content(folder / (store + "/film.exr")) == content(folder / "whole.exr"));
    }
}

TEST_CASE("leases whose times lie far back or ahead are given up") {
    const Folder folder;
    check_ends_well(onde::test::onde(folder, picture({"render"}, {"--film", "whole.exr"})));
    const Arguments worker = picture({"work", "store"}, {"--lease", "60"});
    for (const int years : {-20, 20}) { // the clock stood there when they were taken
        fs::remove_all(folder / "store");
        fs::create_directories(folder / "store/leases");
        for (const char* name : {"t0000-l00-i000000", "t0000-l00-i000003", "film"}) {
            folder.write(std::string("store/leases/") + name, "");
            fs::last_write_time(folder / "store/leases" / name,
                                fs::file_time_type::clock::now() +
                                    std::chrono::hours(24 * 365 * years));
        }
        check_ends_well(onde::test::onde(folder, worker));
        CHECK(content(folder / "store/film.exr") == content(folder / "whole.exr"));
    }
}

TEST_CASE("a clock that jumps by years in mid-job changes no byte of workers and checkpoints") {
    const char* library = "/usr/lib/x86_64-linux-gnu/faketime/libfaketimeMT.so.1";
    if (!fs::exists(library)) return;
    const Folder folder;
    check_ends_well(onde::test::onde(folder, picture({"render"}, {"--film", "whole.exr"})));
    folder.write("clock", "+0d");
    const Environment jumping{{"LD_PRELOAD", library},
                              {"FAKETIME_TIMESTAMP_FILE", folder / "clock"},
                              {"FAKETIME_NO_CACHE", "1"},
                              {"FAKETIME_DONT_FAKE_MONOTONIC", "1"}};
    std::atomic<bool> goes_on{true};
    std::thread clock([&] {
        for (int i = 0; goes_on; i++) {
            folder.write("next", i % 2 == 0 ? "-9y" : "+9y");
            fs::rename(folder / "next", folder / "clock");
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    });
    const Arguments worker = picture({"work", "store"}, {"--tiles", "3x2"});
    Process one(folder, worker, jumping), two(folder, worker, jumping);
    const Outcome render = onde::test::onde(
        folder, picture({"render"}, {"--film", "film.exr", "--checkpoint", "0.05"}), jumping);
    check_ends_well(one.wait());
    check_ends_well(two.wait());
    goes_on = false;
    clock.join();
    check_ends_well(render);
    CHECK(content(folder / "store/film.exr") == content(folder / "whole.exr"));
    CHECK(content(folder / "film.exr") == content(folder / "whole.exr"));
}

TEST_CASE("a worker that is killed costs its lease, and the film has the same bytes") {
    const Folder folder;
    check_ends_well(onde::test::onde(folder, picture({"render"}, {"--film", "whole.exr"})));
    const Arguments worker = picture({"work", "store"}, {"--tiles", "3x2", "--lease", "5"});
    std::mt19937 generator(11);
    for (int kill = 0; kill < 3; ++kill) {
        Process process(folder, worker);
        std::this_thread::sleep_for(std::chrono::milliseconds(100 + generator() % 400));
        process.send(SIGKILL);
        process.wait();
    }
    Process other(folder, worker);
    check_ends_well(onde::test::onde(folder, worker));
    check_ends_well(other.wait());
    CHECK(content(folder / "store/film.exr") == content(folder / "whole.exr"));
}

TEST_CASE("a worker that is told to end gives its lease back") {
    const Folder folder;
    Arguments long_work = picture({"work", "store"});
    *std::ranges::find(long_work, "300") = "100000";
    Process process(folder, long_work);
    for (int i = 0; i < 3000 && !fs::exists(folder / "store/leases/t0000-l00-i000000"); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    process.send(SIGINT);
    CHECK(process.wait().code == 128 + SIGINT);
    CHECK(fs::is_empty(folder / "store/leases"));
}

TEST_CASE("units that are rendered again are compared, and a fault is named") {
    const Folder folder;
    const Arguments worker = picture({"work", "store"}, {"--verify", "100"});
    check_ends_well(onde::test::onde(folder, worker));
    const std::string first = content(folder / "store/notes/t0000-l00-i000002.first");
    CHECK(first.substr(0, 16) ==
          content(folder / "store/notes/t0000-l00-i000002.second").substr(0, 16));
    fs::remove(folder / "store/notes/t0000-l00-i000002.second");
    folder.write("store/notes/t0000-l00-i000002.first", "0123456789abcdef a faulty host (1)");
    const Outcome outcome = onde::test::onde(folder, worker);
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Catch::Contains("samples 128 to 191 of tile 0 have other bits") &&
                                Catch::Contains("a faulty host (1)"));
}

TEST_CASE("what workers can't do together is said in one sentence") {
    const Folder folder;
    const auto check = [&](const Arguments& arguments, const std::string& words) {
        const Outcome outcome = onde::test::onde(folder, arguments);
        INFO(outcome.err);
        CHECK(outcome.code == 2);
        CHECK_THAT(outcome.err, Catch::Contains(words));
    };
    check_ends_well(onde::test::onde(folder, picture({"work", "store"})));
    check(picture({"work", "store"}, {"--seed", "5"}), "film is of another seed");
    check(picture({"work", "store"}, {"--unit", "128"}), "this store was begun with");
    check(picture({"work", "new"}, {"--unit", "192"}), "use 64, 128, 256");
    check(picture({"work", "new"}, {"--tiles", "50x1"}), "do not fit a picture");
    check(picture({"work", "new"}, {"--film", "a.exr"}), "leave out --film");
    check(picture({"work", "new"}, {"--denoise", "onde"}), "leave out --denoise");
    // What a store is of is said before its first unit.
    fs::create_directories(folder / "begun/notes");
    fs::copy(folder / "store/notes/plan", folder / "begun/notes/plan");
    check(picture({"work", "begun"}, {"--seed", "5"}), "film is of another seed");
    CHECK(onde::test::onde(folder, {"farm", "status", "begun"}).code == 0);
    check(picture({"work", "new"}, {"--noise", "0.1"}), "--time and --noise");
    check(picture({"work", "new"}, {"--turntable", "2"}), "a store is of one picture");
    check(picture({"work", "new"}, {"--integrator", "light"}), "light has none");
    check({"farm", "status", "nothing"}, "no worker has begun here");
    CHECK_FALSE(fs::exists(folder / "new")); // what was refused leaves no folder
    fs::create_directory(folder / "own");
    check(picture({"work", "own"}, {"--unit", "192"}), "use 64, 128, 256");
    CHECK(fs::exists(folder / "own"));
}

TEST_CASE("of a unit that is damaged workers say which file to delete, and then go on") {
    const Folder folder;
    const std::string unit = "store/t0000-l00-i000004.exr"; // the last one
    fs::create_directory(folder / "store");
    check_ends_well(
        onde::test::onde(folder, picture({"render"}, {"--samples", "256:300", "--film", unit})));
    std::string bytes = content(folder / unit);
    bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 1);
    folder.write(unit, bytes);
    const Outcome damaged = onde::test::onde(folder, picture({"work", "store"}));
    INFO(damaged.err);
    CHECK(damaged.code == 2);
    CHECK_THAT(damaged.err, Catch::Contains(unit + ": is a damaged film") &&
                                Catch::Contains("delete this file, and a worker does"));
    fs::remove(folder / unit);
    check_ends_well(onde::test::onde(folder, picture({"work", "store"})));
    check_ends_well(onde::test::onde(folder, picture({"render"}, {"--film", "whole.exr"})));
    CHECK(content(folder / "store/film.exr") == content(folder / "whole.exr"));
}
