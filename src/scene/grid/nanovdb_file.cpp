// As util/IO.h of OpenVDB 10 writes them: segments, each a head, what is told of its grids, and
// those one after the other, plain or compressed.
#include "scene/grid/nanovdb_file.h"

#include "scene/load_context.h"

#include <blosc.h>
#include <zlib.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace onde {
namespace {

constexpr uint64_t MAGIC = 0x304244566f6e614e, MAGIC_MASK = 0x00ffffffffffffff; // "NanoVDB0", ...
constexpr uint64_t SEGMENT = 16, META = 176;                                    ///< bytes of heads
constexpr uint16_t PLAIN = 0, ZIP = 1, BLOSC = 2;                               ///< codecs

/// Each segment's grids begin where the last one's end.
void read_heads(const Bytes& file, uint64_t& at, std::vector<StoredGrid>& grids) {
    if ((file.at<uint64_t>(at) & MAGIC_MASK) != (MAGIC & MAGIC_MASK))
        file.fail("it is no NanoVDB file, or damaged");
    const auto count = file.at<uint16_t>(at + 12), codec = file.at<uint16_t>(at + 14);
    at += SEGMENT;
    for (uint16_t i = 0; i < count; ++i) {
        const auto name_size = file.at<uint32_t>(at + 136);
        const std::string_view name = file.part(at + META, name_size);
        grids.push_back({std::string(name.substr(0, name.find('\0'))), file.at<uint32_t>(at + 32),
                         codec, 0, file.at<uint64_t>(at + 8), file.at<uint64_t>(at)});
        at += META + name_size;
    }
}

/// A part that is compressed by itself, behind its size.
std::string_view next_part(const Bytes& file, std::string_view& rest) {
    uint64_t size = 0;
    if (rest.size() >= 8) std::memcpy(&size, rest.data(), 8);
    if (size == 0 || size > rest.size() - 8) file.fail("its sizes disagree; it is damaged");
    const std::string_view part = rest.substr(8, size);
    rest.remove_prefix(8 + size);
    return part;
}

bool unzip(std::string_view part, char* to, uint64_t size) {
    uLongf written = size;
    const int status = uncompress(reinterpret_cast<Bytef*>(to), &written,
                                  reinterpret_cast<const Bytef*>(part.data()), part.size());
    return status == Z_OK && written == size;
}

bool unblosc(std::string_view part, char* to, uint64_t size) {
    size_t told = 0;
    if (blosc_cbuffer_validate(part.data(), part.size(), &told) < 0 || told != size) return false;
    return blosc_decompress_ctx(part.data(), to, size, 1) == int64_t(size);
}

} // namespace

StoredGrid choose_grid(const Bytes& file) {
    std::optional<StoredGrid> chosen;
    for (uint64_t at = 0; at < file.size();) {
        std::vector<StoredGrid> grids;
        read_heads(file, at, grids);
        for (StoredGrid& grid : grids) {
            grid.offset = at;
            at += file.part(at, grid.stored).size();
            if (!chosen || (chosen->name != "density" && grid.name == "density")) chosen = grid;
        }
    }
    if (!chosen) file.fail("it has no grids");
    return *chosen;
}

std::string_view unpacked(LoadContext& context, const std::string& name, const Bytes& file,
                          const StoredGrid& grid, std::string& room) {
    constexpr uint64_t MOST_RATIO = 1100;        // of deflate; of Blosc's it is less
    constexpr uint64_t PART = uint64_t(1) << 30; // that is compressed by itself, by Blosc
    std::string_view rest = file.part(grid.offset, grid.stored);
    if (grid.codec == PLAIN) return rest;
    if (grid.codec != ZIP && grid.codec != BLOSC)
        file.fail("it is compressed in a way that is not known");
    if (grid.size / MOST_RATIO > grid.stored) file.fail("its sizes disagree; it is damaged");
    context.spend(grid.size, 1, name);
    room.resize(grid.size);
    for (uint64_t done = 0; done < grid.size;) {
        const uint64_t size = grid.codec == ZIP ? grid.size : std::min(grid.size - done, PART);
        const std::string_view part = next_part(file, rest);
        const auto unpack = grid.codec == ZIP ? unzip : unblosc;
        if (!unpack(part, room.data() + done, size))
            file.fail("it can't be unpacked; it is damaged");
        done += size;
    }
    return room;
}

} // namespace onde
