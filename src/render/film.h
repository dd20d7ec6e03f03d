// The film: per pixel, linear sums over the samples.
//
// Samples are joined in a fixed tree, so that a million of them lose no digits and no split of the
// work changes a bit. A leaf is a block of 64 consecutive samples, added one by one from zero
// (film_add of kernels/film/film.h). Blocks are joined as aligned pairs only,
//     S[a, a + 2k) = S[a, a + k) + S[a + k, a + 2k),
// by a binary counter: level n of the pending sums holds 2^n blocks, and when a block is full and
// another sample comes, the block is carried into the lowest free level (kernels/film/carry.cl).
// In a film that begins at a later block some nodes are the right half of a pair whose left half is
// another film's: they are finished, and go to the host.
// A picture in between joins the nodes and the last block as the tree says, with the missing
// samples left out. So a film of 64 samples or fewer is the plain sum, and a film goes on from
// wherever it was left.
//
// Splats, which any path may add to any pixel, are exact integers and need no tree.
#pragma once

#include "gpu/buffer_list.h"
#include "gpu/program.h"
#include "image/image.h"
#include "render/film_contents.h"
#include "render/options.h"

#include <optional>
#include <span>
#include <vector>

namespace onde {

/// States the buffers of a film of the options' samples and AOVs.
void plan_film(gpu::BufferList& buffers, const RenderOptions& options);

class Film {
  public:
    /// An empty film with options.aovs and options.light_groups, from options.first_sample on. It
    /// may get more samples than the options say; the buffers for those are in no list. The
    /// programs outlive it.
    Film(gpu::Programs& programs, gpu::BufferList& buffers, const RenderOptions& options);

    /// From now on the film is what the integrator makes of these sums at the end of each pass.
    void hold_splats(const gpu::Buffer<uint32_t>& splats) { splats_ = splats; }

    /// What kernels add to: the sums of the current block, plane by plane.
    const gpu::Buffer<cl_float4>& sums() const { return sums_.block; }
    const gpu::Buffer<uint32_t>& invalid() const { return invalid_; }

    uint32_t width() const { return width_; }
    uint32_t height() const { return height_; }
    const FilmExtent& extent() const { return extent_; }
    /// Per pixel of those that get all, not whole after an interrupted pass.
    double samples() const;

    /// To be called before samples first .. first + count - 1 are added to a list of `pixels`
    /// pixels; the others get none. They lie in one block and follow the film's last ones (an empty
    /// film begins at any block); a pass that was interrupted comes again. Returns how many of the
    /// pixels have them already. Throws InputError otherwise.
    uint32_t begin_pass(uint32_t first, uint32_t count, uint32_t pixels);
    /// The first `pixels` of the list have the samples of the pass.
    void end_wave(uint32_t pixels);

    /// Whether it has that channel, and its picture: pixels without a sample are black.
    bool has(const FilmChannel& channel) const;
    Image develop(const FilmChannel& channel = RADIANCE) const;
    /// The same of several, faster than one by one.
    std::vector<Image> develop(std::span<const FilmChannel> channels) const;
    const FilmPlanes& planes() const { return planes_; }
    /// What the samples have seen, if the options ask for that; whoever adds samples counts here.
    IdCounts& ids() { return ids_; }
    const IdCounts& ids() const { return ids_; }
    /// The sums of an AOV, or of RADIANCE_SUMS, over all blocks of 64 samples that are whole.
    FilmSums whole_blocks(uint32_t sums) const;

    /// Removes its sums. Who counts beside them is in Integrator::clear().
    void clear();
    FilmContents contents() const;
    /// Goes on from there. Throws InputError unless they are of a film of this size, AOVs and first
    /// sample, with splats if this one has them.
    void restore(const FilmContents& contents);

    /// Samples that were thrown away because their radiance was not finite, and the first of them.
    struct Invalid {
        uint32_t count = 0, x = 0, y = 0, sample = 0;
    };
    Invalid find_invalid() const;

    /// Buffers of a float4 per pixel and plane.
    struct Sums {
        gpu::Buffer<cl_float4> block;
        std::vector<gpu::Buffer<cl_float4>> pending; ///< by level
    };

  private:
    uint32_t pixels() const { return width_ * height_; }
    uint32_t sum_count() const { return pixels() * planes_.count(); }
    bool is_splatted() const { return splats_.size() > 0; }
    void build();
    void carry();
    void launch(const char* kernel, const gpu::Buffer<cl_float4>& pending);
    /// Whether the film has every block of that node before its current one.
    bool has(const FilmNode& node) const;
    /// Those before the current block.
    std::vector<FilmNode> nodes() const;
    bool is_block_full() const { return extent_.end == FILM_BLOCK * (uint64_t(block_) + 1); }
    /// Some planes of a node, from the one on.
    FilmSums read(const FilmNode& node, uint32_t plane, uint32_t planes) const;
    FilmSums read_block(uint32_t plane, uint32_t planes) const;
    void put(const FilmPart& part);
    /// The same of all nodes, and where it is asked for, of the current block.
    FilmSums join(bool with_block, uint32_t plane, uint32_t planes) const;

    gpu::Programs& programs_;
    const gpu::Device& device_;
    uint32_t width_, height_, first_sample_;
    FilmPlanes planes_;
    Sums sums_;
    gpu::Buffer<uint32_t> invalid_, splats_;
    FilmExtent extent_;
    uint32_t block_ = 0;             ///< number of the current one, which sums_ has
    uint32_t pass_pixels_;           ///< that get the samples of the last pass
    std::vector<FilmPart> finished_; ///< right halves without the left one
    IdCounts ids_;
    std::optional<gpu::Program> program_; ///< where there are several blocks
};

} // namespace onde
