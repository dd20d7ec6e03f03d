#include "app/film_command.h"

#include "app/json.h"

#include "core/text.h"
#include "film/ledger.h"

#include <fmt/format.h>

#include <memory>

namespace onde::app {
namespace {

struct FilmOptions {
    std::filesystem::path film;
    bool json = false;
};

/// A reader whose parts were all checked.
struct CheckedFilm {
    FilmReader reader;
    std::vector<FilmRange> missing{};

    explicit CheckedFilm(const std::filesystem::path& path) : reader(path) {
        for (size_t part = 0; part < reader.parts().size(); part++) reader.check_part(part);
        reader.check_ids();
        missing = missing_ranges(reader.parts(), reader.header());
    }
};

Json json_of(const std::vector<FilmRange>& ranges) {
    Json list = Json::array();
    for (const FilmRange& range : ranges) {
        Json json = {{"first_sample", range.first}, {"sample_count", range.count},
                     {"x", range.window.x},         {"y", range.window.y},
                     {"width", range.window.width}, {"height", range.window.height}};
        if (range.pass > 0) {
            json["pass"] = range.pass;
            json["pass_pixels"] = range.pass_pixels;
        }
        list.push_back(std::move(json));
    }
    return list;
}

void print_json(const CheckedFilm& film) {
    Json json;
    for (const auto& [key, text] : texts_of(film.reader.header()))
        json[key.substr(key.find(':') + 1)] = text;
    json["parts"] = json_of(film.reader.parts());
    json["missing"] = json_of(film.missing);
    fmt::print("{}", json_text(json));
}

void print_words(const CheckedFilm& film) {
    for (const auto& [key, text] : texts_of(film.reader.header()))
        fmt::print("{:<22} {}\n", key.substr(key.find(':') + 1), printable(text));
    const char* where_needed =
        film.reader.header().identity.noise > 0 ? " as far as they needed them" : "";
    for (const FilmRange& range : film.reader.parts()) {
        fmt::print("has                    {}{}\n", words_of(range), where_needed);
        if (range.pass > 0)
            fmt::print("                       the last {} of them of {} pixels only, as it was "
                       "interrupted\n",
                       range.pass, range.pass_pixels);
    }
    for (const FilmRange& range : film.missing)
        fmt::print("lacks                  {}\n", words_of(range));
}

void run_film(const FilmOptions& options) {
    const CheckedFilm film(options.film);
    options.json ? print_json(film) : print_words(film);
}

} // namespace

void add_film_command(Command& root) {
    Command command = root.add_command("film", "Say what a film file holds and what it lacks");
    const auto options = std::make_shared<FilmOptions>(); // what runs later is copied
    command.option("FILM", &options->film, "A file that onde render --film has written",
                   {.required = true});
    command.flag("--json", options->json, "Print it as JSON");
    command.on_run([options] { run_film(*options); });
}

} // namespace onde::app
