// A process that renders again and again keeps its memory.
#include "session/small_session.h"

#include <unistd.h>

#include <fstream>

namespace onde::test {
namespace {

/// Bytes of this process that are in memory.
double resident_bytes() {
    uint64_t all = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> all >> resident;
    return double(resident) * double(sysconf(_SC_PAGESIZE));
}

SessionOptions tiny_session() {
    SessionOptions options = small_session(IntegratorKind::path, 1);
    options.render.width = 16;
    options.render.height = 12;
    options.render.settings.wave_size = options.render.settings.chunk;
    return options;
}

} // namespace

TEST_CASE("a thousand renders in one process grow its memory by less than 1 % after the first 50") {
    const Scene scene = varied_scene();
    std::vector<float> first;
    double after_50 = 0;
    for (int i = 0; i < 1000; i++) {
        Session session(programs(), scene, tiny_session());
        const std::vector<float> picture = rendered(session);
        if (i == 0) first = picture;
        if (picture != first) FAIL("picture " << i << " is another");
        if (i == 49) after_50 = resident_bytes();
    }
    INFO(after_50 << " bytes after 50, " << resident_bytes() << " after 1000");
    CHECK(resident_bytes() < 1.01 * after_50);
}

TEST_CASE("a session that renders a thousand units keeps its memory") {
    Session session(programs(), varied_scene(), tiny_session());
    RenderOptions options = session.options();
    double after_50 = 0;
    for (uint32_t i = 0; i < 1000; i++) {
        options.first_sample = i * 64; // as units of a picture are
        options.samples = options.first_sample + 1;
        session.set_options(options);
        session.render();
        if (i == 49) after_50 = resident_bytes();
    }
    INFO(after_50 << " bytes after 50, " << resident_bytes() << " after 1000");
    CHECK(resident_bytes() < 1.01 * after_50);
}

} // namespace onde::test
