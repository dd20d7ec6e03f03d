// Whole pictures whose every pixel is known: furnaces, and a floor below a square light.
#include "doctor/checks.h"
#include "doctor/furnaces.h"
#include "doctor/pictures.h"
#include "doctor/tally.h"

namespace onde::doctor {

namespace {

/// The mean of a channel is what it should be, give or take five deviations of it, which the
/// spread of the pixels gives, and single precision.
void expect_mean(Tally& tally, const Image& image, uint32_t channel, double wanted,
                 std::string_view of) {
    double sum = 0, squares = 0;
    const double count = double(image.width) * image.height;
    for (size_t i = channel; i < image.pixels.size(); i += image.channels) {
        sum += image.pixels[i];
        squares += double(image.pixels[i]) * image.pixels[i];
    }
    const double mean = sum / count;
    const double deviation = std::sqrt(std::max(squares / count - mean * mean, 0.0) / count);
    tally.expect_near(mean, wanted, wanted * 2e-5 + 5 * deviation, of);
    tally.expect(deviation < 0.02 * wanted,
                 [&] { return fmt::format("{} is uncertain by {:.2g}", of, deviation); });
}

/// Pixel by pixel: what neither takes nor gives light is not seen in a white world.
void check_invisible(Tally& tally, const CheckContext& context) {
    const auto check = [&](const Material& material, const char* of) {
        RenderOptions options = picture_options(context, 16, 16, 4);
        options.depth = options.roulette_start = 63;
        for (const float pixel : picture_of(context, furnace(material), options).pixels)
            tally.expect_near(pixel, 1, 2e-5, of);
    };
    check(furnace_material(MaterialKind::conductor, glm::vec3(1), 0), "a mirror in the furnace");
    check(furnace_material(MaterialKind::dielectric, glm::vec3(1), 0), "glass in the furnace");
}

void check_diffuse(Tally& tally, const CheckContext& context, uint32_t samples) {
    RenderOptions options = picture_options(context, 16, 16, samples);
    options.depth = options.roulette_start = 24;
    const Material white = furnace_material(MaterialKind::diffuse, glm::vec3(1), 1);
    expect_mean(tally, picture_of(context, furnace(white), options), 0, 1,
                "a white ball in the furnace");
}

/// Inside a box that glows by what it does not reflect: everything is 1, though Russian roulette
/// ends most paths early.
void check_inside(Tally& tally, const CheckContext& context, uint32_t samples) {
    RenderOptions options = picture_options(context, 16, 16, samples);
    options.depth = 64;
    const Image image = picture_of(context, glowing_box({0.5f, 0.25f, 0.75f}), options);
    for (uint32_t k = 0; k < 3; ++k) expect_mean(tally, image, k, 1, "the inside of a glowing box");
}

/// White surfaces return all light, however rough.
void check_rough(Tally& tally, const CheckContext& context) {
    for (const MaterialKind kind :
         {MaterialKind::conductor, MaterialKind::dielectric, MaterialKind::metallic_roughness}) {
        RenderOptions options = picture_options(context, 12, 12, 64);
        options.depth = 32;
        const Material material = furnace_material(kind, glm::vec3(1), 0.5f);
        double mean = 0;
        const Image image = picture_of(context, furnace(material), options);
        for (const float pixel : image.pixels) mean += pixel / double(image.pixels.size());
        tally.expect_near(mean, 1, 0.01, fmt::format("a rough {} in the furnace", word_of(kind)));
    }
}

void check_square_light(Tally& tally, const CheckContext& context, uint32_t samples) {
    Scene scene = floor_seen_from_above(0.5f);
    add_square_light(scene, 1.0f, 1.5f, 3.0f);
    RenderOptions options = picture_options(context, 8, 8, samples);
    options.depth = 2;
    const double wanted = 0.5 / M_PI * irradiance_below_square(1.0, 1.5, 3.0);
    expect_mean(tally, picture_of(context, scene, options), 0, wanted,
                "the floor below a square light");
}

} // namespace

Finding check_furnace(const CheckContext& context) {
    const uint32_t samples = context.quick ? 64 : 512;
    Tally tally;
    check_invisible(tally, context);
    check_diffuse(tally, context, samples);
    check_inside(tally, context, samples);
    check_rough(tally, context);
    check_square_light(tally, context, 4 * samples);
    return tally.finding("values are off");
}

} // namespace onde::doctor
