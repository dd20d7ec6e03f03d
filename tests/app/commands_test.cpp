// The command line itself: its version, its help, its output.
#include "onde_process.h"
#include "support/folders.h"

using namespace onde::test;

TEST_CASE("--version is the version and --help lists the subcommands") {
    const Folder folder;
    CHECK(output_of(folder, {"--version"}) == ONDE_VERSION "\n");
    const std::string help = output_of(folder, {"--help"});
    for (const char* command : {"render", "info", "reference", "inspect", "gallery", "thumbnail",
                                "compare", "devices", "cache"})
        CHECK_THAT(help, Catch::Contains(std::string("\n  ") + command));
}

TEST_CASE("every subcommand has its own help") {
    const Folder folder;
    const std::pair<Arguments, std::string> commands[] = {{{"inspect"}, "--pixel"},
                                                          {{"render"}, "--wave-size"},
                                                          {{"info"}, "--json"},
                                                          {{"compare"}, "--diff"},
                                                          {{"devices"}, "--json"},
                                                          {{"cache"}, "prewarm"},
                                                          {{"cache", "list"}, "Usage"},
                                                          {{"cache", "clear"}, "Usage"},
                                                          {{"cache", "prewarm"}, "--device"}};
    for (auto [command, mentioned] : commands) {
        INFO(command.back());
        command.push_back("--help");
        CHECK_THAT(output_of(folder, command), Catch::Contains(mentioned));
    }
}

TEST_CASE("reference prints the keys of scene files as tables") {
    const Folder folder;
    const std::string text = output_of(folder, {"reference"});
    CHECK_THAT(text, Catch::Contains("<!-- table material -->\n| key | value | default |\n"));
    CHECK_THAT(text, Catch::Contains("| `\"torus\"` |"));
}

TEST_CASE("an output that nobody can read is an error and not a success") {
    const Folder folder;
    const std::string command =
        built_program() + " info " + CORNELL + " > /dev/full 2> " + (folder / "err").string();
    const int status = std::system(command.c_str());
    CHECK(WEXITSTATUS(status) == 2);
    CHECK(content(folder / "err") == "onde: standard output could not be written\n");
}
