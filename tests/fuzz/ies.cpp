// Fuzzes the reader of measured lamps.
#include "fuzz/fuzz.h"

#include "scene/ies.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    try {
        onde::LoadContext context({.limit = uint64_t(256) << 20});
        onde::Notes notes;
        onde::Scene scene;
        scene.photometric_lights.emplace_back().profile =
            onde::read_ies(onde::fuzz::text(data, size), "a.ies", context, notes);
        onde::check_scene(scene);
    } catch (const onde::InputError& error) {
        if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
    }
    return 0;
}
