// Whether a picture is a fair sample of the same expected value as the reference: a Z-test.
#pragma once

#include "image/image.h"
#include "support/reference/reference.h"

#include <string>

namespace onde {

struct Comparison {
    bool accepted = false;
    uint32_t blocks = 0;
    double outlier_fraction = 0.0; ///< of the blocks with |z| > 3
    double outlier_bound = 0.0;    ///< the most of them that is accepted
    double mean_z = 0.0;           ///< of the difference of the whole images; accepted within 4
    double worst_z = 0.0;          ///< device minus reference
    std::string sentence;          ///< the verdict, the worst block and its values
};

/// Compares luminance over blocks of 8x8 pixels. `device` holds the mean of `device_samples`
/// samples in each pixel, and at least 3 channels; its variance is taken from the reference's own,
/// as if its samples were independent too (stratified ones vary less, which makes the test lenient,
/// never wrong).
///
/// z = difference / sqrt(sum of both variances). Path tracing has heavy tails, so 1% of the blocks
/// may lie beyond 3 (a normal distribution has 0.27%), and the bound adds 4 standard deviations of
/// a binomial count of that probability and one block.
/// Throws InputError when the sizes differ or the reference has fewer than 2 samples.
Comparison compare_to_reference(const Image& device, uint32_t device_samples,
                                const ReferenceResult& reference);

} // namespace onde
