#include "app/merge_command.h"

#include "app/interrupt.h"
#include "app/picture_files.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/output.h"
#include "film/ledger.h"
#include "film/merge.h"
#include "image/tone.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace onde::app {
namespace {

namespace fs = std::filesystem;

struct MergeOptions {
    std::vector<fs::path> parts;
    fs::path output, picture;
    std::optional<float> exposure;
    std::optional<ToneMap> tone_map;
    ExrNames names = ExrNames::plain;
    bool full_float = false, complete = false;
};

/// A folder stands for the film files in it.
std::vector<fs::path> part_files(const std::vector<fs::path>& parts) {
    std::vector<fs::path> files;
    for (const fs::path& part : parts) {
        std::error_code error;
        if (!fs::is_directory(part, error)) {
            files.push_back(part);
            continue;
        }
        for (fs::directory_iterator at(part, error), end; !error && at != end; at.increment(error))
            if (is_exr(at->path())) files.push_back(at->path());
        if (error)
            throw InputError("{}: cannot be listed ({}); name its files", part.string(),
                             error.message());
    }
    if (files.empty()) throw InputError("there is no film file to merge; name some");
    std::ranges::sort(files);
    return files;
}

/// A film is .exr, a picture .png: of --output. Each has to be writable, and none of the parts.
void check_outputs(MergeOptions& options, const std::vector<fs::path>& parts) {
    if (lower_extension(options.output) == ".png") {
        if (!options.picture.empty())
            throw InputError("two pictures are asked for; give -o a film file, .exr");
        options.picture = std::exchange(options.output, {});
    }
    if (options.output.empty() && options.picture.empty())
        throw InputError("nothing is to be written; name a film file with -o, or --picture");
    if (!options.output.empty() && !is_exr(options.output))
        throw InputError("{}: a film is written as .exr, a picture as .png; change the extension",
                         options.output.string());
    if (!options.picture.empty() && !is_exr(options.picture) &&
        lower_extension(options.picture) != ".png")
        throw InputError("{}: pictures are written as .png or .exr; change the extension",
                         options.picture.string());
    if (!options.output.empty() && !options.picture.empty() &&
        is_same_file(options.output, options.picture))
        throw InputError("{}: a picture and a film cannot go to the same place; name another",
                         options.output.string());
    for (const fs::path& path : {options.output, options.picture}) {
        if (path.empty()) continue;
        check_writable(path);
        check_not_read(path, parts);
    }
}

void write_picture(const MergeOptions& options, FilmMerge& merge) {
    const FilmHeader& header = merge.header();
    const ImageMetadata metadata{{"onde:scene_hash", header.identity.scene},
                                 {"onde:seed", std::to_string(header.identity.seed)},
                                 {"onde:samples", fmt::format("{:.6g}", merge.samples())},
                                 {"onde:device", header.device},
                                 {"onde:version", header.maker.version},
                                 {"Software", "Onde " + header.maker.version}};
    Display display = header.display;
    display.exposure = options.exposure.value_or(display.exposure);
    display.tone_map = options.tone_map.value_or(display.tone_map);
    const Image picture = merge.picture();
    if (!is_exr(options.picture))
        return write_png(options.picture, straight_alpha(picture), display, metadata);
    const ExrContents all =
        film_contents(merge, picture, metadata, options.full_float, options.names);
    write_exr(options.picture, all.layers, all.metadata);
}

/// Whether a film that is there has samples that the merge has not, or is of another picture.
bool would_lose(const FilmReader& there, const FilmMerge& merge) {
    try {
        check_same(there.header(), merge.header());
    } catch (const InputError&) {
        return true;
    }
    if (merge.header().identity.noise > 0) return there.parts() != merge.joined();
    std::vector<FilmRange> ranges = there.parts();
    const std::vector<FilmRange> missing = merge.missing();
    ranges.insert(ranges.end(), missing.begin(), missing.end());
    return find_overlap(ranges).has_value();
}

/// Throws InputError where the output is a film already, of which something would be lost.
void check_nothing_lost(const fs::path& output, const FilmMerge& merge) {
    std::error_code ignored;
    if (output.empty() || !fs::exists(output, ignored)) return;
    std::optional<FilmReader> there;
    try {
        there.emplace(output);
    } catch (const InputError&) {
        return; // some other file, which outputs replace
    }
    if (would_lose(*there, merge))
        throw InputError("{}: is a film already, with samples that these parts have not; name it "
                         "among them, or another file with -o",
                         output.string());
}

void tell_missing(const std::vector<FilmRange>& missing) {
    constexpr size_t MOST = 8;
    for (size_t i = 0; i < std::min(missing.size(), MOST); i++)
        spdlog::warn("{} are missing", words_of(missing[i]));
    if (missing.size() > MOST)
        spdlog::warn("... and {} more; onde film tells all that a film lacks",
                     missing.size() - MOST);
}

/// Thrown out of a merge that is told to end.
struct Interrupted {};

/// Returns whether it was interrupted.
bool run_merge(MergeOptions options) try {
    const StopOnInterrupt interrupt; // or what is unfinished would stay
    const std::vector<fs::path> files = part_files(options.parts);
    check_outputs(options, files);
    FilmMerge merge(files);
    merge.on_progress([&] {
        if (interrupt.requested()) throw Interrupted();
    });
    check_nothing_lost(options.output, merge);
    tell_missing(merge.missing());
    if (options.complete && !merge.missing().empty())
        throw InputError("the parts are not the whole picture; render what is missing, or leave "
                         "--complete away");
    Outputs outputs;
    if (!options.output.empty())
        outputs.attempt([&] {
            merge.write(options.output);
            tell_written(options.output);
        });
    if (!options.picture.empty())
        outputs.attempt([&] {
            write_picture(options, merge);
            tell_written(options.picture);
        });
    outputs.check();
    return false;
} catch (const Interrupted&) {
    spdlog::warn("interrupted before all was written");
    return true;
}

} // namespace

void add_merge_command(Command& root, bool& interrupted) {
    Command command = root.add_command(
        "merge", "Join film files of one picture, in any order, to the bytes of one render");
    const auto options = std::make_shared<MergeOptions>(); // what runs later is copied
    command.option("PARTS", &options->parts, "Film files, or folders of them", {.required = true});
    command.option("-o,--output", &options->output,
                   "Where it goes: a film file where the name ends in .exr, a picture where it\n"
                   "ends in .png",
                   {.value = "FILE"});
    command.option("--picture", &options->picture,
                   "Also write the picture of what there is, .png or .exr", {.value = "FILE"});
    command.flag("--complete", options->complete,
                 "Write nothing, and exit with 2, where the picture lacks samples");
    command.option("--exposure", &options->exposure, "Brighten the .png by that many stops",
                   {.value = "STOPS", .least = -64, .most = 64});
    command.choice("--tone-map", options->tone_map,
                   "How bright light is shown in the .png (as the render has it)");
    command.choice("--exr-names", options->names, "Names of the channels of an .exr picture");
    command.flag("--float", options->full_float, "Write a 32-bit .exr picture instead of 16-bit");
    command.on_run([options, &interrupted] { interrupted = run_merge(*options); });
}

} // namespace onde::app
