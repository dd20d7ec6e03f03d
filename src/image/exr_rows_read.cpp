#include "image/exr_rows.h"

#include "core/abandoned.h"
#include "core/error.h"

#include <openexr.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstdlib>
#include <set>
#include <string_view>

namespace onde {
namespace {

static_assert(std::endian::native == std::endian::little, "rows are written as they lie");

namespace fs = std::filesystem;

/// Of one attribute, name or table of a header; the library asks for as much as a file claims.
void* allocate_some(size_t bytes) {
    constexpr size_t MOST = size_t(64) << 20;
    return bytes > MOST ? nullptr : std::malloc(bytes);
}

void keep_silent(exr_const_context_t, exr_result_t, const char*) {}

int64_t read_at(exr_const_context_t, void* file, void* to, uint64_t size, uint64_t offset,
                exr_stream_error_func_ptr_t) {
    const int descriptor = *static_cast<const int*>(file);
    uint64_t done = 0;
    while (done < size) {
        const ssize_t got =
            pread(descriptor, static_cast<char*>(to) + done, size - done, off_t(offset + done));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        done += uint64_t(got);
    }
    return int64_t(done);
}

int64_t size_of(exr_const_context_t, void* file) {
    struct stat status {};
    return fstat(*static_cast<const int*>(file), &status) == 0 ? int64_t(status.st_size) : -1;
}

std::string_view text_of(const exr_attr_string_t& text) {
    return {text.str, size_t(text.length)};
}

} // namespace

struct ExrRowReader::File {
    fs::path path;
    Descriptor open;
    int number = open.get();
    exr_context_t context = nullptr;

    ~File() {
        if (context) exr_finish(&context);
    }
    /// Throws InputError unless the library could do it.
    void check(exr_result_t result) const {
        if (result != EXR_ERR_SUCCESS) fail(exr_get_default_error_message(result));
    }
    [[noreturn]] void fail(const std::string& why) const {
        throw InputError("{}: is damaged or no OpenEXR file of parts ({})", path.string(), why);
    }

    Rectangle window(const exr_attr_box2i_t& box) const {
        const int64_t width = int64_t(box.max.x) - box.min.x + 1;
        const int64_t height = int64_t(box.max.y) - box.min.y + 1;
        constexpr int64_t MOST = 65535;
        if (box.min.x < 0 || box.min.y < 0 || width < 1 || height < 1 || box.max.x >= MOST ||
            box.max.y >= MOST)
            fail("its header claims pixels that no picture has");
        return {uint32_t(box.min.x), uint32_t(box.min.y), uint32_t(width), uint32_t(height)};
    }
    std::vector<ExrChannel> channels(int part) const {
        const exr_attr_chlist_t* list = nullptr;
        check(exr_get_channels(context, part, &list));
        std::vector<ExrChannel> channels;
        for (int i = 0; i < list->num_channels; i++) {
            const exr_attr_chlist_entry_t& entry = list->entries[i];
            if (entry.pixel_type == EXR_PIXEL_HALF || entry.x_sampling != 1 ||
                entry.y_sampling != 1)
                fail("its channels are not of 32 bits");
            channels.push_back(
                {std::string(text_of(entry.name)), entry.pixel_type == EXR_PIXEL_FLOAT});
        }
        return channels;
    }
    void read_attributes(int index, ExrPart& part) const {
        int32_t count = 0;
        check(exr_get_attribute_count(context, index, &count));
        for (int32_t i = 0; i < count; i++) {
            const exr_attribute_t* attribute = nullptr;
            check(exr_get_attribute_by_index(context, index, EXR_ATTR_LIST_FILE_ORDER, i,
                                             &attribute));
            if (attribute->type == EXR_ATTR_STRING)
                part.texts.emplace(attribute->name, text_of(*attribute->string));
            if (attribute->type == EXR_ATTR_INT)
                part.numbers.emplace(attribute->name, attribute->i);
        }
    }
    /// A file that is shorter than its rows was cut off.
    uint64_t read_part(int index, ExrPart& part) const {
        exr_storage_t storage{};
        exr_compression_t compression{};
        exr_attr_box2i_t box{};
        check(exr_get_storage(context, index, &storage));
        if (storage != EXR_STORAGE_SCANLINE) fail("it is tiled or deep");
        check(exr_get_compression(context, index, &compression));
        if (compression != EXR_COMPRESSION_NONE) fail("it is compressed");
        check(exr_get_data_window(context, index, &box));
        part.window = window(box);
        part.channels = channels(index);
        const char* name = nullptr;
        if (exr_get_name(context, index, &name) == EXR_ERR_SUCCESS && name) part.name = name;
        read_attributes(index, part);
        return part.window.pixels() * part.channels.size() * sizeof(uint32_t);
    }
};

ExrRowReader::ExrRowReader(const fs::path& path)
    : file_(new File{path, Descriptor(), -1, nullptr}) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored))
        throw InputError("{}: is a folder; name a file", path.string());
    file_->open = Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    file_->number = file_->open.get();
    if (!file_->open)
        throw InputError("{}: cannot be read ({}); check the name", path.string(),
                         std::error_code(errno, std::generic_category()).message());
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    how.error_handler_fn = keep_silent;
    how.alloc_fn = allocate_some;
    how.free_fn = std::free;
    how.user_data = &file_->number;
    how.read_fn = read_at;
    how.size_fn = size_of;
    how.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    file_->check(exr_start_read(&file_->context, path.c_str(), &how));

    int count = 0;
    file_->check(exr_get_count(file_->context, &count));
    uint64_t bytes = 0;
    for (int i = 0; i < count; i++) bytes += file_->read_part(i, parts_.emplace_back());
    if (parts_.empty()) file_->fail("it has no parts");
    if (bytes > uint64_t(size_of(nullptr, &file_->number)))
        file_->fail("it ends before its pixels do");
    exr_attr_box2i_t box{};
    file_->check(exr_get_display_window(file_->context, 0, &box));
    const Rectangle picture = file_->window(box);
    width_ = picture.end_x();
    height_ = picture.end_y();
    for (const ExrPart& part : parts_)
        if (part.window.end_x() > width_ || part.window.end_y() > height_)
            file_->fail("a part of it lies outside of its picture");
}

ExrRowReader::~ExrRowReader() = default;

void ExrRowReader::read_row(size_t part, uint32_t y, std::span<uint32_t> words) {
    exr_chunk_info_t chunk{};
    file_->check(exr_read_scanline_chunk_info(file_->context, int(part), int(y), &chunk));
    if (chunk.packed_size != words.size_bytes()) file_->fail("a row of it has another length");
    file_->check(exr_read_chunk(file_->context, int(part), &chunk, words.data()));
}

} // namespace onde
