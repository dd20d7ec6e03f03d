// Where the system gives programs a small stack, onde gives itself one.
#include "onde_process.h"

using namespace onde::test;

TEST_CASE("a stack of 64 KiB is enough to start with") {
    const Folder folder;
    // The soft limit, and with the hard one nobody can raise it.
    for (const char* limits : {"-S -s 64", "-s 64"}) {
        const std::string script = std::string("ulimit ") + limits + " && exec \"$0\" \"$@\"";
        Process process(folder, render(CORNELL, {"--no-cache", "-o", "a.png"}), {},
                        {"sh", "-c", script});
        const Outcome outcome = process.wait();
        INFO(outcome.err);
        CHECK(outcome.signal == 0);
        CHECK(outcome.code == 0);
        CHECK(fs::exists(folder / "a.png"));
        fs::remove(folder / "a.png");
    }
}
