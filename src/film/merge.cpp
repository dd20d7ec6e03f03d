#include "film/merge.h"

#include "core/error.h"
#include "film/ledger.h"
#include "image/tone.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace onde {
namespace {

/// Of all samples that there can be.
constexpr FilmNode ROOT{32, 0};

bool has_part_in(const FilmNode& node, const FilmNode& part) {
    return part.first_block() >= node.first_block() && part.end_block() <= node.end_block();
}

Rectangle common(const Rectangle& a, const Rectangle& b) {
    Rectangle both{std::max(a.x, b.x), std::max(a.y, b.y), 0, 0};
    const uint32_t end_x = std::min(a.end_x(), b.end_x()), end_y = std::min(a.end_y(), b.end_y());
    if (end_x > both.x && end_y > both.y) {
        both.width = end_x - both.x;
        both.height = end_y - both.y;
    }
    return both;
}

/// Calls work(band) with rectangles of a few rows each.
template <class Work>
void for_each_band(const Rectangle& window, uint32_t rows, const Work& work) {
    for (uint32_t y = window.y; y < window.end_y(); y += rows)
        work(Rectangle{window.x, y, window.width, std::min(rows, window.end_y() - y)});
}

} // namespace

FilmMerge::FilmMerge(std::vector<std::filesystem::path> files) : files_(std::move(files)) {
    for (size_t file = 0; file < files_.size(); file++) add_file(file);
    std::vector<FilmRange> ranges;
    for (const Source& source : sources_) ranges.push_back(source.range);
    if (const auto overlap = find_overlap(ranges)) {
        const Source &a = sources_[overlap->first], &b = sources_[overlap->second];
        throw InputError("{}: has {}, of which {} has some too; leave one of them out",
                         files_[b.file].string(), words_of(b.range), files_[a.file].string());
    }
    joined_ = join_ranges(ranges);
}

void FilmMerge::add_file(size_t file) {
    FilmReader& reader = open(file);
    const FilmHeader& header = reader.header();
    if (header.identity.noise > 0 && files_.size() > 1)
        throw InputError("{}: is of a render that --noise ends, which decides from all of its "
                         "pixels; such films can't be joined with others",
                         files_[file].string());
    const uint32_t samples = std::max(header_.samples, header.samples);
    if (file > 0) check_same(header, header_, files_[file].string());
    // What is not compared is that of the first name, in whatever order they come.
    if (file == 0 || files_[file] < files_[first_name_]) {
        header_ = header;
        first_name_ = file;
    }
    header_.samples = samples;
    for (size_t part = 0; part < reader.parts().size(); part++) {
        reader.check_part(part);
        sources_.push_back({file, part, reader.parts()[part]});
    }
    reader.check_ids();
    if (const auto window = reader.ids_window()) id_windows_.push_back(*window);
}

std::vector<PixelIds> FilmMerge::ids_of(uint32_t y, const Rectangle& window) {
    std::vector<PixelIds> all(window.width), row;
    for (size_t file = 0; file < id_windows_.size(); file++) {
        const Rectangle& own = id_windows_[file];
        if (y < own.y || y >= own.end_y()) continue;
        open(file).read_ids(y, row);
        for (size_t x = 0; x < row.size(); x++)
            for (const IdCount& ids : row[x]) add_id(all[own.x - window.x + x], ids.id, ids.count);
    }
    return all;
}

IdCounts FilmMerge::ids() {
    const Rectangle all{0, 0, header_.identity.width, header_.identity.height};
    IdCounts counts;
    for (uint32_t y = 0; y < all.height && !id_windows_.empty(); y++)
        std::ranges::move(ids_of(y, all), std::back_inserter(counts));
    return counts;
}

void FilmMerge::write_ids(FilmWriter& file, const Rectangle& window) {
    for (uint32_t y = window.y; y < window.end_y() && !id_windows_.empty(); y++)
        file.write_ids(y, ids_of(y, window));
}

FilmReader& FilmMerge::open(size_t file) {
    constexpr size_t MOST_OPEN = 64;
    const auto found =
        std::ranges::find(open_, file, [](const auto& entry) { return entry.first; });
    if (found != open_.end()) {
        open_.splice(open_.begin(), open_, found);
    } else {
        if (open_.size() == MOST_OPEN) open_.pop_back();
        open_.emplace_front(file, files_[file]);
    }
    return open_.front().second;
}

std::vector<FilmRange> FilmMerge::missing() const {
    return missing_ranges(joined_, header_);
}

double FilmMerge::samples() {
    double all = 0;
    if (header_.identity.noise > 0) { // not every pixel has them all
        const std::vector<float> counts = std::move(develop({SAMPLE_COUNT}).front().pixels);
        return std::accumulate(counts.begin(), counts.end(), all) / double(counts.size());
    }
    for (const FilmRange& range : joined_) all += double(range.window.pixels()) * range.count;
    return all / (double(header_.identity.width) * header_.identity.height);
}

uint32_t FilmMerge::band_rows(uint32_t width) const {
    constexpr size_t BAND = size_t(8) << 20;
    const size_t row = sizeof(cl_float4) * width * header_.identity.planes().count();
    return uint32_t(std::max<size_t>(1, BAND / row));
}

FilmMerge::Sources FilmMerge::sources_of(const FilmRange& range, const Rectangle& band) const {
    Sources sources;
    for (const Source& source : sources_)
        if (has_part_in(range.place(), source.range.place()) &&
            source.range.node().has_value() == range.node().has_value() &&
            common(source.range.window, band).pixels() > 0)
            sources.push_back(&source);
    return sources;
}

void FilmMerge::paint(const Source& source, const Rectangle& band, FilmSums& sums) {
    const Rectangle both = common(source.range.window, band);
    FilmReader& file = open(source.file);
    FilmRow row;
    for (uint32_t y = both.y; y < both.end_y(); y++) {
        file.read_row(source.part, y, row);
        for (uint32_t plane = 0; plane < header_.identity.planes().count(); plane++) {
            const size_t to = (size_t(plane) * band.height + y - band.y) * band.width;
            const size_t from = size_t(plane) * source.range.window.width;
            std::copy_n(row.begin() + ptrdiff_t(from + both.x - source.range.window.x), both.width,
                        sums.begin() + ptrdiff_t(to + both.x - band.x));
        }
    }
}

FilmSums FilmMerge::sum(FilmNode node, const Sources& sources, const Rectangle& band) {
    if (on_progress_) on_progress_();
    Sources own, below[2];
    const FilmNode halves[] = {{node.level - 1, 2 * node.index},
                               {node.level - 1, 2 * node.index + 1}};
    for (const Source* source : sources)
        if (source->range.place() == node)
            own.push_back(source);
        else
            below[has_part_in(halves[1], source->range.place())].push_back(source);
    for (const size_t half : {0, 1})
        if (own.empty() && below[1 - half].empty() && !below[half].empty())
            return sum(halves[half], below[half], band);
    FilmSums sums;
    if (below[1].empty())
        sums.resize(band.pixels() * header_.identity.planes().count());
    else
        sums = sum(halves[1], below[1], band);
    if (!below[0].empty()) add_sums(sums, sum(halves[0], below[0], band));
    for (const Source* source : own) paint(*source, band, sums); // of pixels that had none
    return sums;
}

void FilmMerge::write(const std::filesystem::path& path) {
    for (const Source& source : sources_)
        if (source.range.pass > 0)
            throw InputError("{}: was interrupted within {}; go on with it by --resume first",
                             files_[source.file].string(), words_of(source.range));
    const uint32_t planes = header_.identity.planes().count();
    const Rectangle window = ids_window(joined_);
    size_t most = 0; // which decides how many channels the file has
    for (uint32_t y = window.y; y < window.end_y() && !id_windows_.empty(); y++)
        most = std::max(most, most_ids(ids_of(y, window)));
    FilmWriter file(path, header_, joined_, most);
    for (size_t part = 0; part < joined_.size(); part++) {
        const FilmRange& range = joined_[part];
        FilmRow row(size_t(planes) * range.window.width);
        for_each_band(range.window, band_rows(range.window.width), [&](const Rectangle& band) {
            const FilmSums sums = sum(range.place(), sources_of(range, band), band);
            for (uint32_t y = 0; y < band.height; y++) {
                for (uint32_t plane = 0; plane < planes; plane++)
                    std::copy_n(sums.begin() +
                                    ptrdiff_t((size_t(plane) * band.height + y) * band.width),
                                band.width, row.begin() + ptrdiff_t(size_t(plane) * band.width));
                file.write_row(part, band.y + y, row);
            }
        });
    }
    write_ids(file, window);
    file.finish();
}

std::vector<Image> FilmMerge::develop(const std::vector<FilmChannel>& channels) {
    const FilmIdentity& identity = header_.identity;
    std::vector<Image> images;
    for (const FilmChannel& channel : channels)
        images.emplace_back(identity.width, identity.height, channel.components());
    const auto develop_band = [&](const Rectangle& band) {
        Sources sources;
        for (const Source& source : sources_)
            if (common(source.range.window, band).pixels() > 0) sources.push_back(&source);
        const FilmSums sums = sum(ROOT, sources, band);
        for (size_t i = 0; i < channels.size(); i++) {
            const Image rows =
                develop_sums(sums, band.width, band.height, identity.planes(), channels[i]);
            const size_t first = size_t(band.y) * band.width * rows.channels;
            std::ranges::copy(rows.pixels, images[i].pixels.begin() + ptrdiff_t(first));
        }
    };
    for_each_band({0, 0, identity.width, identity.height}, band_rows(identity.width), develop_band);
    return images;
}

Image FilmMerge::picture() {
    if (header_.identity.background != Background::transparent)
        return std::move(develop({RADIANCE}).front());
    const std::vector<Image> images = develop({RADIANCE, *find_channel("alpha")});
    return with_alpha(images[0], images[1]);
}

} // namespace onde
