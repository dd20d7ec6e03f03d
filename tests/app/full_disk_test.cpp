// What `onde` does where the disk is full: a file system of 64 KiB, where mounting one is allowed.
#include "image/image_io.h"
#include "onde_process.h"

#include <sys/mount.h>

#include <cstring>

using namespace onde::test;

namespace {

/// A folder "small" of its own file system in another folder, with a bit of room or none.
class SmallDisk {
  public:
    explicit SmallDisk(const Folder& folder) : path_(folder / "small") {
        fs::create_directories(path_);
        mounted_ = mount("tmpfs", path_.c_str(), "tmpfs", 0, "size=64k,mode=755") == 0;
        if (!mounted_)
            WARN("skipped: no file system can be mounted here (" << std::strerror(errno) << ")");
    }
    ~SmallDisk() {
        if (mounted_) umount(path_.c_str());
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

    bool mounted() const { return mounted_; }

    void fill_but(size_t pages) const {
        constexpr size_t PAGE = 4096;
        std::ofstream out(path_ / "filler", std::ios::binary);
        while (out << std::string(PAGE, 'x') << std::flush)
            ;
        out.close();
        fs::resize_file(path_ / "filler", fs::file_size(path_ / "filler") - pages * PAGE);
    }

    /// What stands in it beside the filler.
    std::map<std::string, std::string> files() const {
        std::map<std::string, std::string> all;
        for (const auto& entry : fs::recursive_directory_iterator(path_))
            if (entry.is_regular_file() && entry.path().filename() != "filler")
                all[entry.path().lexically_relative(path_)] = content(entry.path());
        return all;
    }

  private:
    fs::path path_;
    bool mounted_ = false;
};

/// How often a text stands in another.
size_t count(const std::string& text, const std::string& what) {
    size_t found = 0;
    for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
        ++found;
    return found;
}

void check_refused(const Outcome& outcome, size_t files) {
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(count(outcome.err, "cannot be written (No space left on device)") == files);
}

} // namespace

TEST_CASE("on a full disk old pictures and numbers stay whole, and each failure is told") {
    const Folder folder;
    const SmallDisk disk(folder);
    if (!disk.mounted()) return;
    const std::map<std::string, std::string> old{
        {"a.png", "old png"}, {"b.exr", "old exr"}, {"c.json", "old json"}};
    for (const auto& [name, text] : old) folder.write("small/" + name, text);
    for (const size_t pages : {0, 3}) { // with room for a part of a picture, too
        disk.fill_but(pages);
        const Outcome outcome = onde::test::onde(
            folder, render(CORNELL, {"--size", "160x120", "-o", "small/a.png", "-o", "small/b.exr",
                                     "-o", "elsewhere.png", "--json", "small/c.json"}));
        INFO(pages << " pages: " << outcome.err);
        CHECK(outcome.code == 2);
        CHECK(count(outcome.err, "small/a.png: cannot be written (No space") == 1);
        CHECK(count(outcome.err, "small/b.exr: cannot be written (No space") == 1);
        CHECK(onde::read_image(folder / "elsewhere.png").width == 160);
        auto expected = old;
        if (pages > 0) expected["c.json"] = content(folder / "small/c.json"); // it is small
        CHECK(disk.files() == expected);
    }
}

TEST_CASE("checkpoints on a full disk leave the old film whole, and the render goes on") {
    const Folder folder;
    const SmallDisk disk(folder);
    if (!disk.mounted()) return;
    const Arguments film{"--size", "24x16", "--film", "small/a.exr", "--resume", "small/a.exr"};
    Arguments first = film, more = film;
    first.insert(first.end(), {"--spp", "64"});
    more.insert(more.end(), {"--spp", "256", "--checkpoint", "0.001", "--wave-size", "512", "-o",
                             "picture.png"});
    CHECK(onde::test::onde(folder, render(CORNELL, first)).code == 0);
    const auto before = disk.files();
    REQUIRE(before.size() == 1);
    disk.fill_but(1);
    const Outcome outcome = onde::test::onde(folder, render(CORNELL, more));
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Catch::Contains("a.exr: cannot be written (No space left on device)"));
    CHECK(disk.files() == before);
    CHECK(onde::read_image(folder / "picture.png").width == 24);
    fs::remove(folder / "small/filler");
    CHECK(onde::test::onde(folder, render(CORNELL, more)).code == 0);
    CHECK(disk.files() != before);
}

TEST_CASE("workers and merges on a full disk end in a sentence, and go on when there is room") {
    const Folder folder;
    const SmallDisk disk(folder);
    if (!disk.mounted()) return;
    const auto picture = [](const Arguments& first, const Arguments& more) {
        Arguments all = first;
        all.insert(all.end(), {CORNELL, "--lanes", "8", "--size", "24x16", "--spp", "256"});
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    const Arguments worker = picture({"work", "small/store"}, {});
    CHECK(onde::test::onde(folder, picture({"render"}, {"--film", "whole.exr"})).code == 0);
    for (const size_t pages : {0, 1, 4}) { // with room for leases, and for a unit
        disk.fill_but(pages);
        const Outcome outcome = onde::test::onde(folder, worker);
        INFO(pages << " pages: " << outcome.err);
        CHECK(outcome.code == 2);
        CHECK_THAT(outcome.err, Catch::Contains("No space left on device"));
        for (const auto& [name, bytes] : disk.files())
            if (name.ends_with(".exr")) CHECK(bytes.size() > 4096); // a whole unit
        fs::remove(folder / "small/filler");
    }
    CHECK(onde::test::onde(folder, worker).code == 0);
    CHECK(content(folder / "small/store/film.exr") == content(folder / "whole.exr"));

    fs::remove_all(folder / "small/store");
    disk.fill_but(1);
    const auto before = disk.files();
    const Outcome merge = onde::test::onde(
        folder, {"merge", "whole.exr", "-o", "small/film.exr", "--picture", "picture.png"});
    INFO(merge.err);
    CHECK(merge.code == 2);
    CHECK_THAT(merge.err, Catch::Contains("film.exr: cannot be written (No space left on device)"));
    CHECK(disk.files() == before);
    CHECK(onde::read_image(folder / "picture.png").width == 24);
}

TEST_CASE("thumbnails and turntables on a full disk leave no half file") {
    const Folder folder;
    const SmallDisk disk(folder);
    if (!disk.mounted()) return;
    folder.write("wedge.obj",
                 "v 0 0 0\nv 3 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    folder.write("small/wedge.png", "old");
    folder.write("small/turn.0002.png", "old");
    const auto before = disk.files();
    disk.fill_but(0);
    check_refused(onde::test::onde(folder, {"thumbnail", "wedge.obj", "-o", "small", "--size", "64",
                                            "--spp", "1"}),
                  1);
    CHECK(disk.files() == before);
    const Outcome turn = onde::test::onde(
        folder,
        render("wedge.obj", {"--size", "64x64", "-o", "small/turn.png", "--turntable", "2"}));
    INFO(turn.err);
    CHECK(turn.code == 2);
    CHECK_THAT(turn.err, Catch::Contains("turn.0001.png: cannot be written (No space"));
    CHECK(disk.files() == before);
}
