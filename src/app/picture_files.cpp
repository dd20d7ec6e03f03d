#include "app/picture_files.h"

#include "app/id_channels.h"

#include "core/log.h"
#include "image/tone.h"

#include <algorithm>
#include <optional>

namespace onde::app {
namespace {

namespace fs = std::filesystem;

/// A channel beside the picture.
struct Channel {
    std::string name, letters;
    Image numbers, shown;
    std::optional<IdLayers> ids{}; ///< instead of letters, numbers and what is shown
};

/// Layers that compositors know by other names than ours: Nuke has forward.u and forward.v.
constexpr std::pair<std::string_view, std::string_view> PLAIN_LAYERS[] = {{RADIANCE.name, ""},
                                                                          {"motion", "forward."}};

/// Passes that Blender knows by other names than ours, capitalised.
constexpr std::pair<std::string_view, std::string_view> BLENDER_PASSES[] = {
    {RADIANCE.name, "Combined"},
    {"uv", "UV"},
    {"motion", "Vector"},
    {"emission", "Emit"},
    {"noisy", "Noisy Image"},
    {"denoise-albedo", "Denoising Albedo"},
    {"denoise-normal", "Denoising Normal"}};

const std::string VIEW_LAYER = "ViewLayer.";

template <size_t N>
std::optional<std::string>
known_name(const std::pair<std::string_view, std::string_view> (&names)[N],
           std::string_view channel) {
    const auto* known = std::ranges::find(names, channel, [](auto& p) { return p.first; });
    if (known == std::end(names)) return std::nullopt;
    return std::string(known->second);
}

std::string blender_pass(std::string_view channel) {
    if (channel.starts_with(GROUP_PREFIX)) // as Cycles calls its light groups
        return "Combined_" + std::string(channel.substr(GROUP_PREFIX.size()));
    if (const auto known = known_name(BLENDER_PASSES, channel)) return *known;
    std::string pass(channel);
    bool begins = true;
    for (char& c : pass) {
        if (begins) c = char(std::toupper(c));
        begins = c == '-';
        if (begins) c = ' ';
    }
    return pass;
}

/// "albedo."; compositors want letters, digits and underscores.
std::string plain_layer(std::string_view channel) {
    if (const auto known = known_name(PLAIN_LAYERS, channel)) return *known;
    std::string layer(channel);
    std::ranges::replace(layer, '-', '_');
    return layer + ".";
}

float largest_size(const Image& numbers) {
    float largest = 0;
    for (const float number : numbers.pixels) largest = std::max(largest, std::abs(number));
    return largest;
}

/// As it is seen: directions by their octant, motion likewise, the largest as 1, and alpha as its
/// plain numbers, as mattes are; colours as they are, others grey, where the largest is white.
Image shown_channel(const Image& numbers, const FilmChannel& channel) {
    const bool is_motion = channel.sums == AOV_MOTION;
    const bool is_direction =
        is_motion || channel.sums == AOV_NORMAL || channel.sums == AOV_DENOISE_NORMAL;
    const bool is_matte = channel.sums == AOV_ALPHA;
    const bool is_scaled = is_motion || numbers.channels == 1;
    const float largest = is_scaled ? std::max(largest_size(numbers), 1e-30f) : 1.0f;
    Image shown(numbers.width, numbers.height, numbers.channels == 2 ? 3 : numbers.channels);
    if (is_motion) std::ranges::fill(shown.pixels, linear_from_srgb(0.5f));
    for (size_t i = 0; i < numbers.pixels.size(); i++) {
        const float number = is_matte ? numbers.pixels[i] : numbers.pixels[i] / largest;
        shown.pixels[i / numbers.channels * shown.channels + i % numbers.channels] =
            is_direction ? linear_from_srgb(0.5f + 0.5f * number)
            : is_matte   ? linear_from_srgb(std::clamp(number, 0.0f, 1.0f))
                         : number;
    }
    return shown;
}

Channel traversal_cost(Session& session) {
    const TraversalCost map = session.traversal_cost();
    spdlog::info("{} tests of boxes and primitives by camera rays, {:.1f} per pixel, {} at most",
                 map.sum(), double(map.sum()) / (double(map.width) * map.height), map.largest());
    return {TRAVERSAL_COST, "RGB", cost_numbers(map), heat_picture(map)};
}

Channel film_channel(Session& session, const FilmChannel& channel) {
    Image numbers = session.film().develop(channel);
    Image shown = shown_channel(numbers, channel);
    return {std::string(channel.name), std::string(channel.letters), std::move(numbers),
            std::move(shown)};
}

void add_light_groups(const Session& session, const ShownPicture& shown,
                      std::vector<Channel>& channels) {
    const std::vector<std::string>& groups = session.options().light_groups;
    for (size_t i = 0; i < groups.size(); i++)
        channels.push_back({group_layer(groups[i]), "RGB", shown.groups[i], shown.groups[i]});
}

IdLayers id_layers(IdChannel channel, const SeenThings& things, ExrNames names) {
    return id_layers(channel, things, names == ExrNames::blender ? VIEW_LAYER : "",
                     exr_names(word_of(channel), "X", names).front());
}

Channel id_channel(Session& session, IdChannel channel, ExrNames names) {
    const RenderOptions& options = session.options();
    const IdNames of_things = id_names(session.scene());
    const SeenThings things{session.film().ids(), of_things, options.width, options.height};
    return {std::string(word_of(channel)), {}, {}, {}, id_layers(channel, things, names)};
}

std::vector<Channel> requested_channels(Session& session, const RenderRequest& request,
                                        const ShownPicture& shown) {
    std::vector<Channel> channels;
    for (const std::string& aov : requested_aovs(request, session.scene())) {
        if (aov == LIGHT_GROUPS)
            add_light_groups(session, shown, channels);
        else if (const auto id = value_of<IdChannel>(aov))
            channels.push_back(id_channel(session, *id, request.exr_names));
        else
            channels.push_back(aov == TRAVERSAL_COST ? traversal_cost(session)
                                                     : film_channel(session, *find_channel(aov)));
    }
    return channels;
}

void add_ids(const IdLayers& ids, ExrContents& all) {
    all.layers.insert(all.layers.end(), ids.layers.begin(), ids.layers.end());
    all.metadata.insert(ids.metadata.begin(), ids.metadata.end());
}

/// The picture first, and as it was before it was denoised, then the channels.
ExrContents exr_contents(const ShownPicture& shown, const std::vector<Channel>& channels,
                         ImageMetadata metadata, const RenderRequest& request) {
    const ExrDepth depth = request.full_float ? ExrDepth::full_float : ExrDepth::half_float;
    const std::string_view letters = shown.picture.channels == 4 ? "RGBA" : "RGB";
    ExrContents all{{exr_layer(RADIANCE.name, letters, shown.picture, depth, request.exr_names)},
                    std::move(metadata)};
    if (!shown.denoiser.empty())
        all.layers.push_back({shown.noisy, exr_names("noisy", letters, request.exr_names), depth});
    for (const Channel& channel : channels)
        if (channel.ids)
            add_ids(*channel.ids, all);
        else
            all.layers.push_back(exr_layer(channel.name, channel.letters, channel.numbers, depth,
                                           request.exr_names));
    return all;
}

} // namespace

void tell_written(const fs::path& path) {
    if (!is_standard_output(path)) spdlog::info("wrote {}", fs::absolute(path).string());
}

std::vector<std::string> exr_names(std::string_view channel, std::string_view letters,
                                   ExrNames names) {
    const std::string layer =
        names == ExrNames::plain ? plain_layer(channel) : VIEW_LAYER + blender_pass(channel) + ".";
    std::vector<std::string> all;
    for (const char letter : letters) all.push_back(layer + letter);
    return all;
}

/// Blender's vectors have four components: the way to where a point was a frame ago, and the way
/// back from where it will be at the next. Motion that goes on as it is has the same for both.
static Image blender_vectors(const Image& motion) {
    Image vectors(motion.width, motion.height, 4);
    for (size_t i = 0; i < vectors.pixels.size(); i++)
        vectors.pixels[i] = -motion.pixels[i / 4 * 2 + i % 2];
    return vectors;
}

/// Blender's texture coordinates go up. 0 is where there is no surface.
static Image blender_uvs(Image uvs) {
    for (size_t i = 0; i < uvs.pixels.size(); i += 2)
        if (uvs.pixels[i] != 0 || uvs.pixels[i + 1] != 0) uvs.pixels[i + 1] = 1 - uvs.pixels[i + 1];
    return uvs;
}

ExrLayer exr_layer(std::string_view channel, std::string_view letters, const Image& numbers,
                   ExrDepth depth_of_light, ExrNames names) {
    const FilmChannel* known = find_channel(channel);
    if (known && known->sums == AOV_MOTION && names == ExrNames::blender)
        return {blender_vectors(numbers), exr_names(channel, "XYZW", names), ExrDepth::full_float};
    if (known && known->sums == AOV_UV && names == ExrNames::blender)
        return {blender_uvs(numbers), exr_names(channel, letters, names), ExrDepth::full_float};
    const bool is_light =
        channel == RADIANCE.name || channel.starts_with(GROUP_PREFIX) ||
        (known && known->sums < AOV_COUNT && (LIGHT_AOVS >> known->sums & 1) != 0);
    return {numbers, exr_names(channel, letters, names),
            is_light ? depth_of_light : ExrDepth::full_float};
}

ExrContents film_contents(FilmMerge& merge, const Image& picture, ImageMetadata metadata,
                          bool full_float, ExrNames names) {
    const FilmIdentity& film = merge.header().identity;
    std::vector<std::string> groups;
    for (const std::string& group : film.light_groups) groups.push_back(group_layer(group));
    std::vector<FilmChannel> channels;
    for (const FilmChannel& channel : FILM_CHANNELS)
        if (channel.sums < AOV_COUNT && film.planes().has(channel.sums))
            channels.push_back(channel);
    for (const std::string& group : groups)
        channels.push_back(group_channel(group, size_t(&group - groups.data())));
    const std::vector<Image> images = merge.develop(channels);
    const ExrDepth depth = full_float ? ExrDepth::full_float : ExrDepth::half_float;
    const std::string_view letters = picture.channels == 4 ? "RGBA" : "RGB";
    ExrContents all{{exr_layer(RADIANCE.name, letters, picture, depth, names)},
                    std::move(metadata)};
    for (size_t i = 0; i < channels.size(); i++)
        all.layers.push_back(
            exr_layer(channels[i].name, channels[i].letters, images[i], depth, names));
    const IdCounts counts = merge.ids();
    const SeenThings things{counts, merge.header().names, film.width, film.height};
    for (const EnumWord<IdChannel>& line : WORDS_OF<IdChannel>)
        if (film.has_ids()) add_ids(id_layers(line.value, things, names), all);
    return all;
}

void write_picture_files(const std::vector<fs::path>& paths, Outputs& outputs, Session& session,
                         const RenderRequest& request, const ShownPicture& shown,
                         const ImageMetadata& metadata) {
    const Display display = requested_display(session, request);
    const std::vector<Channel> channels = requested_channels(session, request, shown);
    const bool has_exr = std::ranges::any_of(paths, is_exr);
    const ExrContents all =
        has_exr ? exr_contents(shown, channels, metadata, request) : ExrContents{};
    const auto write = [&](const fs::path& path, const auto& write_to) {
        outputs.attempt([&] {
            write_to(path);
            tell_written(path);
        });
    };
    for (const fs::path& path : paths) {
        write(path, [&](const fs::path& to) {
            if (is_exr(to)) return write_exr(to, all.layers, all.metadata);
            write_png(to, straight_alpha(shown.picture), display, metadata);
        });
        if (is_exr(path) || is_standard_output(path)) continue;
        for (const Channel& channel : channels)
            write(aov_path(path, channel.name), [&](const fs::path& to) {
                write_png(to, channel.ids ? channel.ids->shown : channel.shown, {}, metadata);
            });
    }
}

} // namespace onde::app
