#include "scene/load_context.h"

#include "core/error.h"
#include "core/files.h"
#include "core/memory.h"
#include "image/image_io.h"
#include "scene/references.h"

namespace onde {

LoadContext::LoadContext(const LoadOptions& options)
    : options_(options), left_(options.limit ? options.limit : available_memory() / 4) {
    options_.limit = left_;
}

void LoadContext::spend(uint64_t count, uint64_t size, const std::string& where) {
    if (size == 0) return;
    if (count > left_ / size)
        throw OverBudget("{}: loading it takes more than the {:.3g} GiB that a load may use; "
                         "give more by --load-limit, or split the scene",
                         where, double(options_.limit) / double(1 << 30));
    left_ -= count * size;
}

Notes LoadContext::notes_of(const std::filesystem::path& file) const {
    return Notes(file.string(), options_.strict);
}

std::filesystem::path LoadContext::resolve(const std::filesystem::path& folder,
                                           const std::string& reference, const std::string& where) {
    const auto path = resolve_inside(folder, reference, where, options_.root);
    return *files_.insert(path).first;
}

TexelImage decode_within(LoadContext& context, std::span<const uint8_t> file,
                         const std::string& name) {
    const ImageSize size = image_size(file, name);
    const uint64_t texel = 4 * size.sample_bytes;
    context.spend(size.pixels(), 2 * texel, name); // here and packed
    return decode_texels(file, name);
}

std::string read_file_within(LoadContext& context, const std::filesystem::path& path,
                             uint64_t limit) {
    std::error_code error;
    const uint64_t size = std::filesystem::file_size(path, error);
    if (!error && size <= limit) context.spend(size, 1, path.string());
    return read_file(path, limit);
}

} // namespace onde
