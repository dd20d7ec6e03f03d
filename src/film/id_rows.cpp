#include "film/id_rows.h"

#include <fmt/format.h>

#include <stdexcept>

namespace onde {

std::vector<ExrChannel> id_channels(size_t slots) {
    std::vector<ExrChannel> channels;
    for (size_t slot = 0; slot < slots; slot++)
        for (const char* name : {"count", "material", "object"})
            channels.push_back({fmt::format("id.{:04}.{}", slot, name), false});
    return channels;
}

void pack_ids(std::span<const PixelIds> pixels, size_t slots, std::span<uint32_t> words) {
    const size_t width = pixels.size();
    for (size_t slot = 0; slot < slots; slot++)
        for (size_t x = 0; x < width; x++) {
            const IdCount none, &ids = slot < pixels[x].size() ? pixels[x][slot] : none;
            uint32_t* word = &words[id_words(slot, width) + x];
            word[0] = ids.count;
            word[width] = ids.id.material;
            word[2 * width] = ids.id.object;
        }
}

void unpack_ids(std::span<const uint32_t> words, size_t slots, std::span<PixelIds> pixels) {
    const size_t width = pixels.size();
    for (size_t x = 0; x < width; x++) {
        PixelIds& ids = pixels[x];
        ids.clear();
        for (size_t slot = 0; slot < slots; slot++) {
            const uint32_t* word = &words[id_words(slot, width) + x];
            if (word[0] == 0) break;
            ids.push_back({{word[2 * width], word[width]}, word[0]});
            if (slot > 0 && !(ids[slot - 1].id < ids[slot].id))
                throw std::runtime_error("its ids are in no order");
        }
    }
}

} // namespace onde
