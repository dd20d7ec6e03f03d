// Commands, options and what is said of wrong ones.
#include "core/command_line.h"
#include "core/error.h"

#include <catch2/catch.hpp>

namespace onde {
namespace {

enum class Colour { red, blue };

constexpr auto enum_words(Colour) {
    return std::array{EnumWord{Colour::red, "red"}, EnumWord{Colour::blue, "blue"}};
}

/// A program with one command, as the words after its name call it.
struct Program {
    std::string file;
    std::optional<uint32_t> count, seed;
    float area = 1;
    std::vector<std::string> names;
    Colour colour = Colour::red;
    std::optional<Colour> edge;
    std::optional<Colour> varnish;
    bool twice = false;
    bool quiet = false;
    int runs = 0;

    bool call(std::vector<std::string> words) {
        const std::map<std::string, bool> coats{{"one", false}, {"two", true}};
        CommandLine line("program", "It paints.", "1.2");
        Command root = line.root();
        root.require_command();
        Command paint = root.add_command("paint", "Paint a file");
        paint.option("file", &file, "To paint", {.required = true});
        paint.option("--count", &count, "How often", {.value = "N", .least = 1, .most = 9});
        paint.option("--seed", &seed, "Of chance");
        paint.option("--area", &area, "Of the wall");
        paint.option("--names", &names, "Of painters", {.delimiter = ','});
        paint.choice("--colour", colour, "Of the paint");
        paint.choice("--edge", edge, "Colour of the edge");
        paint.choice_or_alone("--varnish", varnish, Colour::blue, "Colour of a last coat");
        paint.choice("--coats", twice, coats, "How many");
        paint.flag("--quiet", quiet, "Say nothing");
        paint.on_run([this] { ++runs; });
        words.insert(words.begin(), "program");
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        return line.run(int(argv.size()), argv.data());
    }
};

} // namespace

TEST_CASE("an option may stand alone before anything that is no value of it") {
    const auto varnish_of = [](std::vector<std::string> words) {
        Program program;
        words.insert(words.begin(), "paint");
        CHECK(program.call(words));
        CHECK(program.file == "wall.png");
        return program.varnish;
    };
    CHECK_FALSE(varnish_of({"wall.png"}));
    CHECK(varnish_of({"--varnish", "wall.png"}) == Colour::blue);
    CHECK(varnish_of({"--varnish", "red", "wall.png"}) == Colour::red);
    CHECK(varnish_of({"--varnish=red", "wall.png"}) == Colour::red);
    CHECK(varnish_of({"wall.png", "--varnish"}) == Colour::blue);
    CHECK(varnish_of({"--varnish", "--quiet", "wall.png"}) == Colour::blue);
    Program program;
    CHECK_THROWS_AS(program.call({"paint", "--varnish=green", "wall.png"}), InputError);
}

TEST_CASE("a command runs once, with every option where it belongs") {
    Program program;
    CHECK(program.call({"paint", "--names", "a,b", "wall.png", "--count=3", "--colour", "blue",
                        "--coats", "two", "--edge", "red"}));
    CHECK(program.runs == 1);
    CHECK(program.file == "wall.png");
    CHECK(program.count == 3u);
    CHECK(program.names == std::vector<std::string>{"a", "b"});
    CHECK(program.colour == Colour::blue);
    CHECK(program.edge == Colour::red);
    CHECK(program.twice);
    CHECK_FALSE(program.quiet);
}

TEST_CASE("what is wrong with a command line is said in one sentence that names it") {
    const std::pair<std::vector<std::string>, const char*> wrong[] = {
        {{}, "a command is missing; use one of paint; see program --help"},
        {{"pain"}, "pain: no such command; did you mean paint? See program --help"},
        {{"sing"}, "sing: no such command; see program --help"},
        {{"paint"}, "file is required; see program paint --help"},
        {{"paint", "a", "--cuont", "3"}, "--cuont: no such option; did you mean --count?"},
        {{"paint", "a", "--colou=red"}, "--colou: no such option; did you mean --colour?"},
        {{"paint", "a", "--zigzag"}, "--zigzag: no such option; see program paint --help"},
        {{"paint", "a", "b"}, "b: one word more than program paint takes"},
        {{"paint", "a", "--count"}, "--count needs a value behind it; see"},
        {{"paint", "a", "--count", "1", "--count", "2"}, "--count is given twice; give it once"},
        {{"paint", "a", "--count", "x"}, "--count = x: not a value that this option takes"},
        {{"paint", "a", "--count", "10"}, "--count: 10 is out of range; use 1 to 9"},
        {{"paint", "a", "--count", "nan"}, "--count: nan is out of range"},
        {{"paint", "a", "--seed", "4294967296"},
         "--seed: 4294967296 is out of range; use 0 to 4294967295"},
        {{"paint", "a", "--seed=-1"}, "--seed: -1 is out of range"},
        {{"paint", "a", "--area", "1e39"}, "--area: 1e39 is out of range; use -3.4028235e+38 to"},
        {{"paint", "a", "--area", "1e999"}, "--area: 1e999 is out of range"},
        {{"paint", "a", "--colour", "bleu"},
         "--colour: bleu is none of red, blue; did you mean blue?"},
        {{"paint", "a", "--colour", "green"}, "--colour: green is none of red, blue; see"}};
    for (const auto& [words, part] : wrong) {
        Program program;
        INFO(part);
        try {
            program.call(words);
            FAIL_CHECK("nothing was said");
        } catch (const InputError& error) {
            const std::string sentence = error.what();
            CHECK_THAT(sentence, Catch::Contains(part) && Catch::EndsWith("--help"));
            CHECK(sentence.find('\n') == std::string::npos);
        }
        CHECK(program.runs == 0);
    }
}

TEST_CASE("pairs of numbers") {
    using Pair = std::pair<uint32_t, uint32_t>;
    CHECK(parse_pair("640x480", 'x', "--size") == Pair{640, 480});
    CHECK(parse_pair("3,4", ',', "--pixel") == Pair{3, 4});
    for (const char* text : {"", "3", "3,", ",4", "3,4,5", "-3,4", "3, 4", "3x4", "4294967296;1"})
        CHECK_FALSE(parse_pair(text, ',', "--pixel"));
    for (const char* text : {"4294967296,1", "1,99999999999999999999999"})
        CHECK_THROWS_WITH(parse_pair(text, ',', "--pixel"),
                          Catch::StartsWith("--pixel " + std::string(text)) &&
                              Catch::Contains("a number that is too large"));
}

} // namespace onde
