// Pictures of textures whose files have more than 8 bits, from the file to the film.
#include "image/image_io.h"
#include "render/picture.h"
#include "scene/scratch.h"

namespace onde::test {
namespace {

/// A square that fills the picture, of a material with those lines.
Scene square_of(const ScratchFolder& folder, const std::string& material) {
    return load_scene(folder.write("square.toml", R"([camera]
position = [0, 0, 2]
look_at = [0, 0, 0]
vertical_fov = 20
[[material]]
name = "m"
)" + material + R"(
[[shape]]
type = "rectangle"
size = [4, 4]
material = "m"
)"));
}

Image picture_of(const Scene& scene, uint32_t width, uint32_t height) {
    RenderOptions options = small_options(width, height, 16);
    options.depth = 2;
    return render_scene(scene, options).image;
}

/// Of one texel.
void write_texel(const ScratchFolder& folder, glm::vec3 color, ExrDepth depth) {
    Image image(1, 1, 3);
    image.pixels = {color.x, color.y, color.z};
    write_exr(folder.path() / "a.exr", image, {}, depth);
}

void check_all(const Image& image, glm::vec3 color) {
    for (size_t i = 0; i < image.pixels.size(); i++)
        REQUIRE(image.pixels[i] == Approx(color[glm::length_t(i % 3)]).epsilon(1e-5));
}

} // namespace

TEST_CASE("an OpenEXR texture of radiance 50 emits 50, as halves and as floats") {
    ScratchFolder folder;
    for (const glm::vec3 radiance : {glm::vec3(50, 0.5f, 0.0009765625f), glm::vec3(50.1f, 1e6f, 0)})
        for (const ExrDepth depth : {ExrDepth::half_float, ExrDepth::full_float}) {
            if (depth == ExrDepth::half_float && radiance.y > 65504) continue;
            write_texel(folder, radiance, depth);
            const Scene scene = square_of(folder, R"(kind = "diffuse"
base_color = 0
emission = 1
emission_texture = "a.exr"
)");
            check_all(picture_of(scene, 8, 8), radiance);
        }
}

TEST_CASE("a base colour of floats keeps its range where it is shown, and reflects at most all") {
    ScratchFolder folder;
    write_texel(folder, {5, 0.25f, 1}, ExrDepth::full_float);
    const std::string map = "base_color = 1\nbase_color_texture = \"a.exr\"\n";
    check_all(picture_of(square_of(folder, "kind = \"unlit\"\n" + map), 8, 8), {5, 0.25f, 1});
    Scene lit = square_of(folder, "kind = \"diffuse\"\n" + map);
    lit.environment = Environment{.radiance = glm::vec3(1), .map = {}}; // not the studio
    const Image image = picture_of(lit, 32, 32);
    double sum = 0;
    for (size_t i = 0; i < image.pixels.size(); i += 3) {
        sum += double(image.pixels[i]);
        REQUIRE(image.pixels[i + 1] == Approx(0.25f * image.pixels[i]));
    }
    CHECK(sum / (32 * 32) == Approx(1).margin(0.05));
}

TEST_CASE("a ramp of 16 bits has no steps where one of 8 bits would have one value") {
    constexpr uint32_t TEXELS = 64, FIRST = 128 * 257 - 120;
    Scene scene = square_of({}, "kind = \"unlit\"\nbase_color = 1\n");
    Texture ramp;
    ramp.wrap_u = Wrap::clamp;
    ramp.image.width = TEXELS;
    ramp.image.height = 1;
    for (uint32_t x = 0; x < TEXELS; x++) {
        const uint32_t code = FIRST + 2 * x; // all are 128 of 255
        for (uint32_t c = 0; c < 4; c++) {
            ramp.image.rgba.push_back(uint8_t(c < 3 ? code >> 8 : 255));
            ramp.image.low.push_back(uint8_t(c < 3 ? code : 255));
        }
    }
    scene.textures.push_back(ramp);
    scene.materials[scene.meshes[0].materials[0]].base_color_texture = 0;
    const Image image = picture_of(scene, 32, 32);
    for (uint32_t x = 1; x < image.width; x++) {
        const float step = image.pixel(x, 0)[0] - image.pixel(x - 1, 0)[0];
        REQUIRE(step > 0);
        REQUIRE(step < 1.0f / 65535);
    }
}

} // namespace onde::test
