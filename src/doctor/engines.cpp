// The engines, widths, layouts and splits are different ways to the same bits.
#include "doctor/built_in_scene.h"
#include "doctor/checks.h"
#include "doctor/pictures.h"
#include "doctor/tally.h"
#include "doctor/variants.h"
#include "upload/layout_choice.h"

namespace onde::doctor {

namespace {

/// Of the widths that the device shades by; few of them in a quick check, as each is compiled.
std::vector<Variant> variants_for(const CheckContext& context) {
    const uint32_t own = gpu::default_settings(context.facts()).width;
    std::vector<Variant> all;
    for (const Variant& variant : VARIANTS) {
        if (variant.width > own) continue;
        const bool is_first_of_kind =
            variant.width == 1 && (variant.engine == Engine::megakernel || own > 1);
        if (!context.quick || is_first_of_kind) all.push_back(variant);
    }
    return all;
}

void expect_same(Tally& tally, const Image& wanted, const Image& got, std::string_view of) {
    for (size_t i = 0; i < wanted.pixels.size(); ++i)
        tally.expect(std::bit_cast<uint32_t>(wanted.pixels[i]) ==
                         std::bit_cast<uint32_t>(got.pixels[i]),
                     [&] {
                         return fmt::format("{}: pixel {},{} channel {} is {} and {}", of,
                                            i / 3 % wanted.width, i / 3 / wanted.width, i % 3,
                                            wanted.pixels[i], got.pixels[i]);
                     });
}

} // namespace

Finding check_engines(const CheckContext& context) {
    const Scene scene = built_in_scene();
    const RenderOptions options = picture_options(context, 40, 28, 3);
    const Image wanted = picture_of(context, scene, options);
    Tally tally;
    for (const Variant& variant : variants_for(context))
        expect_same(tally, wanted, picture_of(context, scene, apply(options, variant)),
                    variant.name);
    for (const BvhLayout layout : layouts_for(context.facts()))
        expect_same(tally, wanted, picture_of(context, scene, options, layout),
                    fmt::format("layout {}", word_of(layout)));
    RenderOptions split = options;
    split.settings.wave_size = 4 * std::max(split.settings.chunk, 64u);
    split.samples_in_flight = 1;
    expect_same(tally, wanted, picture_of(context, scene, split), "small waves");
    return tally.finding("numbers differ");
}

} // namespace onde::doctor
