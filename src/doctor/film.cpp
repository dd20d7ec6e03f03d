// The film's sums: blocks of 64 samples that are joined as aligned pairs.
#include "doctor/checks.h"
#include "doctor/film_rig.h"
#include "doctor/tally.h"

namespace onde::doctor {

Finding check_film(const CheckContext& context) {
    Tally tally;
    for (const size_t count : {1u, 5u, 63u, 64u, 65u, 128u, 129u, 448u, 1000u}) {
        const std::vector<float> samples = random_samples(count, 7);
        FilmRig rig(context.programs, 3);
        rig.add_all(samples);
        const Image image = rig.film.develop();
        const float mean = mean_of(samples);
        const float wanted[] = {mean, 2 * mean, 0}; // light is not below 0
        for (size_t i = 0; i < image.pixels.size(); i++)
            tally.expect(image.pixels[i] == wanted[i % 3], [&] {
                return fmt::format("channel {} of {} samples is {} instead of {}", i % 3, count,
                                   image.pixels[i], wanted[i % 3]);
            });
    }
    return tally.finding("sums differ");
}

} // namespace onde::doctor
