#include "gpu/buffer_list.h"

namespace onde::gpu {

uint64_t total_bytes(std::span<const BufferSize> buffers) {
    uint64_t bytes = 0;
    for (const BufferSize& buffer : buffers) bytes += buffer.bytes;
    return bytes;
}

void BufferList::note(std::string name, size_t count, size_t element_size) {
    sizes_.push_back({std::move(name), uint64_t(count) * element_size});
}

} // namespace onde::gpu
