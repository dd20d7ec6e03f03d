// Sets of pixels as bands of rows with equal spans. Each set has one such form, whatever rectangles
// it was made from: equal sets compare equal, and are told in the same words.
#pragma once

#include "core/rectangle.h"

#include <span>
#include <utility>
#include <vector>

namespace onde {

/// One of columns x rows tiles, counted by rows, that cover the rectangle.
Rectangle tile_of(const Rectangle& whole, uint32_t columns, uint32_t rows, uint32_t tile);

class Region {
  public:
    Region() = default;
    explicit Region(const Rectangle& rectangle);
    /// The pixels of any of these, which may overlap.
    explicit Region(std::span<const Rectangle> rectangles);

    bool empty() const { return bands_.empty(); }
    /// Disjoint, in the order of their upper left pixels.
    std::vector<Rectangle> rectangles() const;

    friend Region operator|(const Region& a, const Region& b);
    friend Region operator&(const Region& a, const Region& b);
    friend Region operator-(const Region& a, const Region& b);
    bool operator==(const Region&) const = default;

  private:
    using Span = std::pair<uint32_t, uint32_t>; ///< begin and end along x
    struct Band {
        uint32_t begin = 0, end = 0; ///< rows
        std::vector<Span> spans;     ///< apart from each other

        bool operator==(const Band&) const = default;
    };

    /// Those pixels whose membership in a and in b `keep` accepts.
    template <class Keep>
    static Region combine(const Region& a, const Region& b, Keep keep);
    void add(Band band);

    std::vector<Band> bands_; ///< from the top; neighbours differ
};

} // namespace onde
