#include "core/error.h"
#include "image/exr_rows.h"

#include <openexr.h>

#include <exception>

namespace onde {

struct ExrRowWriter::File {
    WholeFile& out;
    std::vector<ExrPart> parts;
    std::string header{}; ///< as far as it is written
    bool in_header = true;
    std::exception_ptr failure{}; ///< of the disk
    exr_context_t context = nullptr;

    ~File() {
        if (context) exr_finish(&context);
    }
    void check(exr_result_t result) const {
        if (failure) std::rethrow_exception(failure);
        if (result != EXR_ERR_SUCCESS)
            throw InputError("an OpenEXR file could not be made ({})",
                             exr_get_default_error_message(result));
    }
    void write(uint64_t offset, std::string_view bytes) {
        if (in_header) {
            header.resize(std::max<size_t>(header.size(), offset + bytes.size()));
            header.replace(offset, bytes.size(), bytes);
        }
        out.write_at(offset, bytes);
    }
    void add(const ExrPart& part, const exr_attr_box2i_t& picture);
};

namespace {

void keep_silent(exr_const_context_t, exr_result_t, const char*) {}

exr_attr_box2i_t box_of(const Rectangle& r) {
    return {{int32_t(r.x), int32_t(r.y)}, {int32_t(r.end_x()) - 1, int32_t(r.end_y()) - 1}};
}

} // namespace

void ExrRowWriter::File::add(const ExrPart& part, const exr_attr_box2i_t& picture) {
    int index = 0;
    check(exr_add_part(context, part.name.c_str(), EXR_STORAGE_SCANLINE, &index));
    const exr_attr_box2i_t window = box_of(part.window);
    const exr_attr_v2f_t centre{0, 0};
    check(exr_initialize_required_attr(context, index, &picture, &window, 1.0f, &centre, 1.0f,
                                       EXR_LINEORDER_INCREASING_Y, EXR_COMPRESSION_NONE));
    for (const ExrChannel& channel : part.channels)
        check(exr_add_channel(context, index, channel.name.c_str(),
                              channel.is_float ? EXR_PIXEL_FLOAT : EXR_PIXEL_UINT,
                              EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
    for (const auto& [key, text] : part.texts)
        check(exr_attr_set_string(context, index, key.c_str(), text.c_str()));
    for (const auto& [key, number] : part.numbers)
        check(exr_attr_set_int(context, index, key.c_str(), number));
}

ExrRowWriter::ExrRowWriter(WholeFile& file, uint32_t width, uint32_t height,
                           std::vector<ExrPart> parts)
    : file_(new File{file, std::move(parts)}) {
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    how.error_handler_fn = keep_silent;
    how.user_data = file_.get();
    how.write_fn = [](exr_const_context_t, void* user, const void* bytes, uint64_t size,
                      uint64_t offset, exr_stream_error_func_ptr_t) -> int64_t {
        File& to = *static_cast<File*>(user);
        try {
            to.write(offset, {static_cast<const char*>(bytes), size});
        } catch (...) { // not through a library of C
            to.failure = std::current_exception();
            return -1;
        }
        return int64_t(size);
    };
    file_->check(exr_start_write(&file_->context, "film", EXR_WRITE_FILE_DIRECTLY, &how));
    const exr_attr_box2i_t picture = box_of({0, 0, width, height});
    for (const ExrPart& part : file_->parts) file_->add(part, picture);
    file_->check(exr_write_header(file_->context));
    file_->in_header = false;
}

ExrRowWriter::~ExrRowWriter() = default;

void ExrRowWriter::write_row(size_t part, uint32_t y, std::span<const uint32_t> words) {
    file_->check(exr_write_scanline_chunk(file_->context, int(part), int(y), words.data(),
                                          words.size_bytes()));
}

void ExrRowWriter::set_text(size_t part, const std::string& key, const std::string& text) {
    // The part's header begins behind those of the parts before it, each of which has the key.
    const std::string name = key + '\0' + "string" + '\0';
    size_t at = 0;
    for (size_t i = 0; i <= part; i++) at = file_->header.find(name, at) + name.size();
    constexpr size_t SIZE = 4;
    if (file_->header.size() < at + SIZE + text.size())
        throw std::logic_error("there is no attribute " + key);
    file_->out.write_at(at + SIZE, text);
}

void ExrRowWriter::finish() {
    exr_context_t done = file_->context;
    file_->context = nullptr;
    file_->check(exr_finish(&done));
}

} // namespace onde
