#include "render/film.h"

#include "core/error.h"

#include "shared/frame.h"

#include <algorithm>
#include <bit>

namespace onde {
namespace {

/// Whether a film may get more than one block. Splats, which are exact, are never carried.
bool has_several_blocks(const RenderOptions& options) {
    return options.integrator != IntegratorKind::light &&
           (options.samples > FILM_BLOCK || options.seconds > 0);
}

/// Levels that the blocks are carried to; the last block stays where it is added.
size_t pending_levels(const RenderOptions& options) {
    if (!has_several_blocks(options)) return 0;
    if (options.seconds > 0) return 0; // nobody knows how many; they are allocated when they come
    return size_t(std::bit_width((options.samples - 1) / FILM_BLOCK));
}

std::vector<Film::Plane> make_planes(gpu::BufferList& buffers, const RenderOptions& options,
                                     std::span<const FilmChannel> channels) {
    const size_t pixels = size_t(options.width) * options.height;
    uint32_t count = 0;
    for (const FilmChannel& channel : channels) count = std::max(count, channel.plane + 1);
    std::vector<Film::Plane> planes(count);
    for (Film::Plane& plane : planes) {
        plane.block = buffers.add<cl_float4>("film sums", pixels);
        for (size_t level = 0; level < pending_levels(options); level++)
            plane.pending.push_back(buffers.add<cl_float4>(
                fmt::format("film sums of {} samples", FILM_BLOCK << level), pixels));
    }
    return planes;
}

} // namespace

void plan_film(gpu::BufferList& buffers, const RenderOptions& options,
               std::span<const FilmChannel> channels) {
    make_planes(buffers, options, channels);
    buffers.add<uint32_t>("invalid samples", INVALID_SIZE);
}

Film::Film(gpu::Programs& programs, gpu::BufferList& buffers, const RenderOptions& options,
           std::span<const FilmChannel> channels)
    : programs_(programs), device_(programs.device()), width_(options.width),
      height_(options.height), channels_(channels.begin(), channels.end()),
      planes_(make_planes(buffers, options, channels)),
      invalid_(buffers.add<uint32_t>("invalid samples", INVALID_SIZE)) {
    if (has_several_blocks(options)) build();
    clear();
}

void Film::build() {
    const gpu::DeviceSettings settings = gpu::default_settings(device_.facts());
    const size_t items = (pixels() + settings.chunk - 1) / settings.chunk;
    const uint32_t local = settings.local_size;
    program_ =
        programs_.build({"film/carry.cl", {}, {{"join", local, items}, {"carry", local, items}}});
}

double Film::samples() const {
    return extent_.end - extent_.begin + double(extent_.pass) * extent_.pixels / pixels();
}

uint32_t Film::begin_pass(uint32_t first, uint32_t count) {
    if (samples() == 0) extent_.begin = extent_.end = first;
    const bool follows = first == extent_.end && (extent_.pixels == 0 || count == extent_.pass);
    if (!follows || count == 0 || count > FILM_BLOCK - first % FILM_BLOCK)
        throw InputError("{} samples from {} can't follow sample {} of a film", count, first,
                         extent_.end);
    const bool is_full = extent_.end % FILM_BLOCK == 0 && extent_.end > extent_.begin;
    if (is_full && extent_.pass == 0 && splats_.size() == 0)
        for (Plane& plane : planes_) carry(plane);
    extent_.pass = count;
    return extent_.pixels;
}

void Film::end_wave(uint32_t pixels) {
    extent_.pixels = pixels;
    if (pixels < this->pixels()) return;
    extent_.end += extent_.pass;
    extent_.pass = extent_.pixels = 0;
}

/// Levels of which some may hold something.
size_t Film::levels() const {
    return splats_.size() > 0 ? 0 : size_t(std::bit_width(extent_.block()));
}

void Film::carry(Plane& plane) {
    const auto level = size_t(std::countr_one(extent_.block())); // of the block that is full
    while (plane.pending.size() <= level) plane.pending.emplace_back(device_, pixels());
    for (size_t below = 0; below < level; below++)
        if (extent_.is_pending(below)) launch("join", plane.pending[below], plane);
    launch("carry", plane.pending[level], plane);
}

void Film::launch(const char* name, const gpu::Buffer<cl_float4>& pending, const Plane& plane) {
    if (!program_) build();
    const uint32_t chunk = gpu::default_settings(device_.facts()).chunk;
    gpu::Kernel& kernel = program_->kernel(name);
    kernel.set_from(0, pixels(), chunk, pending, plane.block);
    kernel.launch((pixels() + chunk - 1) / chunk);
}

FilmSums Film::join(const Plane& plane) const {
    FilmSums sums = plane.block.read(device_);
    for (size_t level = 0; level < levels(); level++) {
        if (!extent_.is_pending(level)) continue;
        const FilmSums pending = plane.pending[level].read(device_);
        for (size_t i = 0; i < sums.size(); i++)
            for (size_t k = 0; k < 4; k++) sums[i].s[k] += pending[i].s[k];
    }
    return sums;
}

Image Film::develop(const FilmChannel& channel) const {
    const FilmSums sums = join(planes_.at(channel.plane));
    Image image(width_, height_, channel.components);
    for (size_t i = 0; i < sums.size(); i++) {
        const float divisor = channel.develop == Develop::mean ? sums[i].s[3] : 1.0f;
        for (uint32_t k = 0; k < channel.components; k++)
            image.pixels[channel.components * i + k] =
                divisor > 0 ? sums[i].s[channel.first + k] / divisor : 0.0f;
    }
    return image;
}

void Film::clear() {
    extent_ = {};
    for (Plane& plane : planes_) plane.block.fill(device_, cl_float4{});
    splats_.fill(device_, 0u);
    invalid_.fill(device_, 0u);
}

FilmContents Film::contents() const {
    FilmContents contents{width_, height_, extent_, {}, splats_.read(device_)};
    for (const Plane& plane : planes_) {
        FilmContents::Plane copy{plane.block.read(device_), {}};
        for (size_t level = 0; level < levels(); level++)
            copy.pending.push_back(extent_.is_pending(level) ? plane.pending[level].read(device_)
                                                             : FilmSums());
        contents.planes.push_back(std::move(copy));
    }
    return contents;
}

void Film::restore(const FilmContents& contents) {
    if (contents.width != width_ || contents.height != height_ ||
        contents.planes.size() != planes_.size() || contents.splats.size() != splats_.size())
        throw InputError("a film of {}x{} pixels can't go on with one of {}x{}, or of another kind",
                         width_, height_, contents.width, contents.height);
    clear();
    extent_ = contents.extent;
    splats_.write(device_, contents.splats);
    for (size_t i = 0; i < planes_.size(); i++) {
        const std::vector<FilmSums>& pending = contents.planes[i].pending;
        planes_[i].block.write(device_, contents.planes[i].block);
        while (planes_[i].pending.size() < pending.size())
            planes_[i].pending.emplace_back(device_, pixels());
        for (size_t level = 0; level < pending.size(); level++)
            planes_[i].pending[level].write(device_, pending[level]);
    }
}

Film::Invalid Film::find_invalid() const {
    const std::vector<uint32_t> words = invalid_.read(device_);
    return {words[INVALID_COUNT], words[INVALID_PIXEL] & 0xffff, words[INVALID_PIXEL] >> 16,
            words[INVALID_SAMPLE]};
}

} // namespace onde
