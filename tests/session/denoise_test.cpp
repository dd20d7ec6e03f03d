// A session's picture without its noise.
#include "session/small_session.h"

#include "core/error.h"
#include "image/compare.h"

namespace onde::test {
namespace {

SessionOptions denoising_session(uint32_t samples = 16) {
    SessionOptions options = small_session(IntegratorKind::path, samples);
    options.denoiser.denoiser = Denoiser::own;
    options.render.aovs = denoiser_aovs();
    return options;
}

} // namespace

TEST_CASE("a session's denoised picture is nearer to the reference, and the film stays") {
    Session session(programs(), varied_scene(), denoising_session(4));
    session.render();
    const Image noisy = session.picture();
    const DenoisedImage denoised = session.denoised();
    CHECK(denoised.denoiser == "Onde");
    CHECK(denoised.seconds > 0);
    CHECK(session.picture().pixels == noisy.pixels);
    Session reference(programs(), varied_scene(), small_session(IntegratorKind::path, 512));
    reference.render();
    CHECK(compare(denoised.picture, reference.picture()).relative_mse <
          0.7 * compare(noisy, reference.picture()).relative_mse);
}

TEST_CASE("a denoised picture has the same bits by both engines and from any stop") {
    SessionOptions options = denoising_session();
    Session wavefront(programs(), varied_scene(), options);
    wavefront.render([](const Progress& progress) { return progress.samples < 4; });
    wavefront.render();
    options.render.engine = Engine::megakernel;
    Session megakernel(programs(), varied_scene(), options);
    megakernel.render();
    CHECK(wavefront.denoised().picture.pixels == megakernel.denoised().picture.pixels);
}

TEST_CASE("denoising keeps the alpha of a transparent background") {
    SessionOptions options = denoising_session();
    options.render.background = Background::transparent;
    options.render.aovs |= 1u << AOV_ALPHA;
    Session session(programs(), varied_scene(), options);
    session.render();
    const Image noisy = session.picture(), denoised = session.denoised().picture;
    REQUIRE(denoised.channels == 4);
    bool differs = false;
    for (size_t i = 0; i < noisy.pixels.size(); i += 4) {
        CHECK(denoised.pixels[i + 3] == noisy.pixels[i + 3]);
        differs |= denoised.pixels[i] != noisy.pixels[i];
    }
    CHECK(differs);
}

TEST_CASE("a session without a denoiser has no denoised picture") {
    Session session(programs(), varied_scene(), small_session());
    CHECK_FALSE(session.has_denoiser());
    CHECK_THROWS_AS(session.denoised(), InputError);
}

TEST_CASE("what finds no albedo and normals is refused a denoiser") {
    SessionOptions options = small_session(IntegratorKind::whitted);
    options.denoiser.denoiser = Denoiser::own;
    CHECK_THROWS_WITH(Session(programs(), varied_scene(), options),
                      Catch::Contains("--denoise") && Catch::Contains("whitted"));
}

} // namespace onde::test
