// Bilinear texture lookups, at every wrap mode and across the borders.
#include "doctor/checks.h"
#include "doctor/exact.h"
#include "doctor/scene_probe.h"
#include "doctor/tally.h"
#include "doctor/textured_scene.h"
#include "gpu/settings.h"
#include "upload/layout_choice.h"

namespace onde::doctor {

Finding check_textures(const CheckContext& context) {
    const size_t count = context.quick ? 512 : 4096;
    const Scene scene = textured_scene();
    SceneProbe probe(context.programs, scene, {"texture"},
                     gpu::default_settings(context.facts()).width, {},
                     {.layout = known_layout(context.facts())});
    Generator generator(52);
    Tally tally;
    for (uint32_t t = 0; t < scene.textures.size(); t++) {
        Columns in{word_column(count, t), uniform_column(generator, count, -2.5f, 3.5f),
                   uniform_column(generator, count, -2.5f, 3.5f)};
        for (size_t i = 0; i < 41; i++) { // borders and middles of texels
            in[1][i] = (float(i) - 20) / 8;
            in[2][i + 40] = (float(i) - 20) / 8;
        }
        const Columns out = probe.run("texture", in, 7);
        for (size_t k = 0; k < 7; k++) // as data, as colour, alpha
            for (size_t i = 0; i < count; i++) {
                const bool is_color = k >= 3 && k < 6;
                const double wanted =
                    look_up(scene.textures[t], in[1][i], in[2][i], k == 6 ? 3 : k % 3, is_color);
                tally.expect_near(out[k][i], wanted, 5e-6,
                                  fmt::format("texture {} at ({}, {})", t, in[1][i], in[2][i]));
            }
    }
    return tally.finding("lookups are off");
}

} // namespace onde::doctor
