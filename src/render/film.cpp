#include "render/film.h"

#include "core/error.h"
#include "render/noise.h"

#include "shared/frame.h"

#include <algorithm>
#include <bit>

namespace onde {
namespace {

static_assert(FILM_BLOCK == 2 * HALF_BLOCK);

/// Whether a film may get more than one block. Splats, which are exact, are never carried.
bool has_several_blocks(const RenderOptions& options) {
    return options.integrator != IntegratorKind::light &&
           (options.samples - options.first_sample > FILM_BLOCK || options.seconds > 0);
}

/// Levels that the blocks are carried to; the last block stays where it is added.
size_t pending_levels(const RenderOptions& options) {
    if (!has_several_blocks(options)) return 0;
    // Where nobody knows how many there will be, they are allocated when they come.
    if (options.seconds > 0 || options.noise > 0) return 0;
    return size_t(std::bit_width((options.samples - 1 - options.first_sample) / FILM_BLOCK));
}

FilmPlanes planes_of(const RenderOptions& options) {
    return {options.aovs, uint32_t(options.light_groups.size())};
}

Film::Sums make_sums(gpu::BufferList& buffers, const RenderOptions& options) {
    const size_t count = size_t(options.width) * options.height * planes_of(options).count();
    Film::Sums sums;
    sums.block = buffers.add<cl_float4>("film sums", count);
    for (size_t level = 0; level < pending_levels(options); level++)
        sums.pending.push_back(buffers.add<cl_float4>(
            fmt::format("film sums of {} samples", FILM_BLOCK << level), count));
    return sums;
}

} // namespace

void plan_film(gpu::BufferList& buffers, const RenderOptions& options) {
    make_sums(buffers, options);
    buffers.add<uint32_t>("invalid samples", INVALID_SIZE);
}

Film::Film(gpu::Programs& programs, gpu::BufferList& buffers, const RenderOptions& options)
    : programs_(programs), device_(programs.device()), width_(options.width),
      height_(options.height), first_sample_(options.first_sample), planes_(planes_of(options)),
      sums_(make_sums(buffers, options)),
      invalid_(buffers.add<uint32_t>("invalid samples", INVALID_SIZE)),
      pass_pixels_(width_ * height_) {
    if (options.ids) ids_.resize(pixels());
    if (has_several_blocks(options)) build();
    clear();
}

void Film::build() {
    const gpu::DeviceSettings settings = gpu::default_settings(device_.facts());
    const size_t items = (sum_count() + settings.chunk - 1) / settings.chunk;
    const uint32_t local = settings.local_size;
    program_ =
        programs_.build({"film/carry.cl", {}, {{"join", local, items}, {"carry", local, items}}});
}

double Film::samples() const {
    return extent_.end - extent_.begin + double(extent_.pass) * extent_.pixels / pass_pixels_;
}

uint32_t Film::begin_pass(uint32_t first, uint32_t count, uint32_t pixels) {
    if (samples() == 0) {
        extent_.begin = extent_.end = first;
        block_ = first / FILM_BLOCK;
    }
    const bool follows = first == extent_.end && (extent_.pixels == 0 || count == extent_.pass);
    const bool begins_block = extent_.begin % FILM_BLOCK == 0 || is_splatted();
    if (!follows || !begins_block || count == 0 || count > FILM_BLOCK - first % FILM_BLOCK)
        throw InputError("{} samples from {} can't follow sample {} of a film", count, first,
                         extent_.end);
    if (is_block_full() && !is_splatted()) carry();
    extent_.pass = count;
    pass_pixels_ = pixels;
    return extent_.pixels;
}

void Film::end_wave(uint32_t pixels) {
    extent_.pixels = pixels;
    if (pixels < pass_pixels_) return;
    extent_.end += extent_.pass;
    extent_.pass = extent_.pixels = 0;
}

bool Film::has(const FilmNode& node) const {
    return node.first_block() * FILM_BLOCK >= extent_.begin && node.end_block() <= block_;
}

std::vector<FilmNode> Film::nodes() const {
    if (is_splatted()) return {};
    return cover(extent_.begin / FILM_BLOCK, block_);
}

void Film::carry() {
    FilmNode node{0, block_};
    for (; node.is_right() && has(node.sibling()); node = node.parent())
        launch("join", sums_.pending[node.level]);
    if (node.is_right()) {
        finished_.push_back({node, sums_.block.read(device_)});
        sums_.block.fill(device_, cl_float4{});
    } else {
        while (sums_.pending.size() <= node.level) sums_.pending.emplace_back(device_, sum_count());
        launch("carry", sums_.pending[node.level]);
    }
    block_++;
}

void Film::launch(const char* name, const gpu::Buffer<cl_float4>& pending) {
    if (!program_) build();
    const uint32_t chunk = gpu::default_settings(device_.facts()).chunk;
    gpu::Kernel& kernel = program_->kernel(name);
    kernel.set_from(0, sum_count(), chunk, pending, sums_.block);
    kernel.launch((sum_count() + chunk - 1) / chunk);
}

FilmSums Film::read(const FilmNode& node, uint32_t plane, uint32_t planes) const {
    const size_t first = size_t(plane) * pixels(), count = size_t(planes) * pixels();
    if (!node.is_right()) return sums_.pending[node.level].read(device_, first, count);
    const FilmSums& all = std::ranges::find(finished_, node, &FilmPart::node)->sums;
    return {all.begin() + ptrdiff_t(first), all.begin() + ptrdiff_t(first + count)};
}

FilmSums Film::read_block(uint32_t plane, uint32_t planes) const {
    return sums_.block.read(device_, size_t(plane) * pixels(), size_t(planes) * pixels());
}

FilmSums Film::join(bool with_block, uint32_t plane, uint32_t planes) const {
    std::vector<FilmNode> all = nodes();
    const size_t carried = all.size();
    if (with_block) all.push_back({0, block_});
    const auto load = [&](size_t i) {
        return i < carried ? read(all[i], plane, planes) : read_block(plane, planes);
    };
    return join_nodes(std::span<const FilmNode>(all), load, add_sums);
}

FilmSums Film::whole_blocks(uint32_t sums) const {
    const bool is_full = is_block_full();
    if (!is_full && nodes().empty()) return FilmSums(pixels(), cl_float4{});
    return join(is_full, planes_.plane(sums), 1);
}

void add_sums(FilmSums& sums, const FilmSums& more) {
    for (size_t i = 0; i < sums.size(); i++)
        for (size_t k = 0; k < 4; k++) sums[i].s[k] += more[i].s[k];
}

void add_part(std::vector<FilmPart>& parts, FilmPart part) {
    while (part.node.is_right() && !parts.empty() && parts.back().node == part.node.sibling()) {
        add_sums(part.sums, parts.back().sums);
        part.node = part.node.parent();
        parts.pop_back();
    }
    parts.push_back(std::move(part));
}

const FilmChannel* find_channel(std::string_view name) {
    const auto* channel = std::ranges::find(FILM_CHANNELS, name, &FilmChannel::name);
    return channel == std::end(FILM_CHANNELS) ? nullptr : channel;
}

bool Film::has(const FilmChannel& channel) const {
    return planes_.has(channel.sums);
}

/// The light that a scene keeps from the ground is estimated: of few samples, more than there is.
static float developed(float sum, float samples, Develop develop) {
    if (develop == Develop::sum) return sum;
    if (!(samples > 0.0f)) return 0.0f;
    const float mean = sum / samples;
    if (develop == Develop::mean) return mean;
    const float light = std::max(mean, 0.0f);
    return develop == Develop::share ? std::min(light, 1.0f) : light;
}

/// Of the mean of so many samples, without bias, from the sums of them and of their squares. One
/// sample tells nothing of its variance; it is taken to be its square.
static float variance_of_mean(float sum, float squares, float samples) {
    if (!(samples > 0.0f)) return 0.0f;
    const double n = samples;
    if (n < 2) return squares;
    return float(std::max(squares - double(sum) * sum / n, 0.0) / (n * (n - 1)));
}

Image Film::develop(const FilmChannel& channel) const {
    return std::move(develop(std::span(&channel, 1)).front());
}

std::vector<Image> Film::develop(std::span<const FilmChannel> channels) const {
    for (const FilmChannel& channel : channels)
        if (!has(channel))
            throw InputError("the film has no {}; ask for it before rendering", channel.name);
    std::vector<Image> images;
    if (channels.empty()) return images;
    const FilmSums sums = join(true, 0, planes_.count());
    for (const FilmChannel& channel : channels)
        images.push_back(develop_sums(sums, width_, height_, planes_, channel));
    return images;
}

Image develop_sums(const FilmSums& all, uint32_t width, uint32_t height, const FilmPlanes& planes,
                   const FilmChannel& channel) {
    const size_t pixels = size_t(width) * height;
    const std::span sums = std::span(all).subspan(planes.plane(channel.sums) * pixels, pixels);
    if (channel.develop == Develop::error)
        return standard_error({width, height, std::span(all).first(pixels), sums});
    Image image(width, height, channel.components());
    for (size_t i = 0; i < sums.size(); i++)
        for (uint32_t k = 0; k < channel.components(); k++)
            image.pixels[channel.components() * i + k] =
                channel.develop == Develop::variance
                    ? variance_of_mean(all[i].s[k], sums[i].s[k], sums[i].s[3])
                    : developed(sums[i].s[channel.first + k], sums[i].s[3], channel.develop);
    return image;
}

void Film::clear() {
    extent_ = {.begin = first_sample_, .end = first_sample_};
    block_ = first_sample_ / FILM_BLOCK;
    finished_.clear();
    for (PixelIds& ids : ids_) ids.clear();
    sums_.block.fill(device_, cl_float4{});
    splats_.fill(device_, 0u);
    invalid_.fill(device_, 0u);
}

FilmContents Film::contents() const {
    FilmContents contents{width_, height_, planes_, extent_, {}, sums_.block.read(device_), {}, {}};
    contents.ids = ids_;
    contents.splats = splats_.read(device_);
    for (const FilmNode& node : nodes())
        contents.parts.push_back({node, read(node, 0, planes_.count())});
    if (is_splatted() || !is_block_full()) return contents;
    add_part(contents.parts, {{0, block_}, std::move(contents.block)});
    contents.block.assign(sum_count(), cl_float4{});
    return contents;
}

void Film::put(const FilmPart& part) {
    if (part.node.is_right()) {
        finished_.push_back(part);
        return;
    }
    while (sums_.pending.size() <= part.node.level)
        sums_.pending.emplace_back(device_, sum_count());
    sums_.pending[part.node.level].write(device_, part.sums);
}

void Film::restore(const FilmContents& contents) {
    if (contents.width != width_ || contents.height != height_ || contents.planes != planes_ ||
        contents.splats.size() != splats_.size() || contents.ids.size() != ids_.size())
        throw InputError("a film of {}x{} pixels can't go on with one of {}x{}, or of another kind",
                         width_, height_, contents.width, contents.height);
    if (contents.extent.begin != first_sample_)
        throw InputError("a film from sample {} on can't go on with one from {} on", first_sample_,
                         contents.extent.begin);
    clear();
    extent_ = contents.extent;
    block_ = extent_.end / FILM_BLOCK;
    for (const FilmPart& part : contents.parts) put(part);
    ids_ = contents.ids;
    splats_.write(device_, contents.splats);
    sums_.block.write(device_, contents.block);
}

Film::Invalid Film::find_invalid() const {
    const std::vector<uint32_t> words = invalid_.read(device_);
    return {words[INVALID_COUNT], words[INVALID_PIXEL] & 0xffff, words[INVALID_PIXEL] >> 16,
            words[INVALID_SAMPLE]};
}

} // namespace onde
