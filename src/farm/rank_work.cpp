#include "farm/rank_work.h"

#include "core/error.h"

#include <algorithm>
#include <sstream>

namespace onde {
namespace {

FilmNode node_of(const StoreKey& key) {
    return {key.level, key.index};
}

std::string text_of(const std::vector<StoreKey>& keys) {
    std::string text;
    for (const StoreKey& key : keys) text += name_of(key) + "\n";
    return text;
}

std::set<StoreKey> keys_of(const std::string& text) {
    std::set<StoreKey> keys;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (const auto key = key_of(line)) keys.insert(*key);
    return keys;
}

} // namespace

RankWork::RankWork(Ranks& ranks, const Store& store, WorkPlan plan, Worker::Render render)
    : ranks_(ranks), store_(store), plan_(std::move(plan)), render_(std::move(render)) {
    if (ranks_.rank() == 0) begin_plan(store_, plan_);
    const bool is_first = ranks_.rank() == 0;
    before_ = keys_of(ranks_.broadcast(is_first ? text_of(store_.list()) : ""));
}

uint32_t RankWork::owner(const StoreKey& node) const {
    return uint32_t((node_of(node).first_block() * plan_.tiles() + node.tile) % ranks_.count());
}

FilmRange RankWork::range(const StoreKey& node) const {
    FilmRange range = range_of(node_of(node), plan_.window(node.tile));
    range.count = std::min(range.count, plan_.header.samples - range.first);
    return range;
}

size_t RankWork::sum_count(const StoreKey& node) const {
    return plan_.window(node.tile).pixels() * plan_.header.identity.planes().count();
}

/// The node of an earlier job's that has the unit.
std::optional<StoreKey> RankWork::done_before(uint32_t tile, uint32_t index) const {
    for (StoreKey key{tile, 0, index}; key.level < 24; key = key.parent())
        if (before_.contains(key)) return key;
    return std::nullopt;
}

std::optional<KeptFilm> RankWork::run() {
    for (uint32_t index = 0; index < plan_.units(); index++)
        for (uint32_t tile = 0; tile < plan_.tiles(); tile++)
            if (!do_unit(tile, index)) return std::nullopt;
    return gather();
}

bool RankWork::do_unit(uint32_t tile, uint32_t index) {
    StoreKey node{tile, 0, index};
    const auto before = done_before(tile, index);
    if (before && index + 1 != node_of(*before).end_block()) return true;
    node = before.value_or(node);
    if (owner(node) == ranks_.rank()) {
        const auto renew = [] {}; // nobody else takes it
        if (!before && !render_(plan_.window(tile), plan_.samples(index), store_.path(node), renew))
            return false;
        rendered_ += !before;
        held_[node] = load(node);
    }
    for (; node.index % 2 != 0 && range(node).node(); node = node.parent()) join(node);
    return true;
}

void RankWork::join(const StoreKey& right) {
    const StoreKey left = right.sibling();
    const uint32_t from = owner(right), to = owner(left);
    if (ranks_.rank() == from && from != to) ranks_.send(to, take(right));
    if (ranks_.rank() != to) return;
    FilmSums sums = from == to ? take(right) : ranks_.receive(from, sum_count(right));
    add_sums(sums, take(left));
    save(right.parent(), sums);
    for (const StoreKey& half : {left, right}) store_.remove(half);
    held_[right.parent()] = std::move(sums);
}

FilmSums RankWork::take(const StoreKey& node) {
    return std::move(held_.extract(node).mapped());
}

FilmSums RankWork::load(const StoreKey& node) const {
    FilmReader file(store_.path(node));
    check_same(file.header(), plan_.header, file.path().string());
    if (file.parts() != std::vector{range(node)})
        throw InputError("{}: has {} instead of {}; remove it", file.path().string(),
                         words_of(file.parts().front()), words_of(range(node)));
    file.check_part(0);
    FilmSums sums;
    FilmRow row;
    const Rectangle window = plan_.window(node.tile);
    for (uint32_t y = window.y; y < window.end_y(); y++) {
        file.read_row(0, y, row);
        sums.insert(sums.end(), row.begin(), row.end());
    }
    return sums;
}

void RankWork::save(const StoreKey& node, const FilmSums& sums) const {
    const Rectangle window = plan_.window(node.tile);
    const size_t row = sums.size() / window.height;
    FilmWriter file(store_.path(node), plan_.header, {range(node)});
    for (uint32_t y = 0; y < window.height; y++)
        file.write_row(0, window.y + y, std::span(sums).subspan(y * row, row));
    file.finish();
}

/// Rows of a window into sums of the whole picture.
static void paint(const FilmSums& rows, const Rectangle& window, const FilmContents& film,
                  FilmSums& sums) {
    const uint32_t planes = film.planes.count();
    for (uint32_t y = 0; y < window.height; y++)
        for (uint32_t plane = 0; plane < planes; plane++) {
            const size_t from = (size_t(y) * planes + plane) * window.width;
            const size_t to = (size_t(plane) * film.height + window.y + y) * film.width + window.x;
            std::copy_n(rows.begin() + ptrdiff_t(from), window.width, sums.begin() + ptrdiff_t(to));
        }
}

/// The sums of every pixel of a node that nothing joins further, at rank 0.
FilmSums RankWork::gather(const FilmNode& node, const FilmContents& film) {
    FilmSums sums;
    if (ranks_.rank() == 0) sums.resize(size_t(film.planes.count()) * film.width * film.height);
    for (uint32_t tile = 0; tile < plan_.tiles(); tile++) {
        const StoreKey key{tile, node.level, node.index};
        const uint32_t from = owner(key);
        if (ranks_.rank() == 0)
            paint(from == 0 ? take(key) : ranks_.receive(from, sum_count(key)), plan_.window(tile),
                  film, sums);
        else if (ranks_.rank() == from)
            ranks_.send(0, take(key));
    }
    return sums;
}

KeptFilm RankWork::gather() {
    const FilmIdentity& identity = plan_.header.identity;
    const uint32_t samples = plan_.header.samples, blocks = samples / FILM_BLOCK;
    KeptFilm film{plan_.header, {0, 0, identity.width, identity.height}, {}};
    FilmContents& contents = film.contents;
    contents.width = identity.width;
    contents.height = identity.height;
    contents.planes = identity.planes();
    contents.extent.end = samples;
    for (const FilmNode& node : cover(0, blocks))
        contents.parts.push_back({node, gather(node, contents)});
    if (samples % FILM_BLOCK != 0)
        contents.block = gather({0, blocks}, contents);
    else
        contents.block.resize(size_t(contents.planes.count()) * contents.width * contents.height);
    return film;
}

WorkPlan plan_for_ranks(const Store& store, const FilmHeader& header, uint32_t ranks,
                        uint64_t pixels) {
    constexpr uint32_t UNITS_A_RANK = 4;
    WorkPlan plan{.header = header};
    const uint64_t wanted = (uint64_t(UNITS_A_RANK) * ranks + plan.units() - 1) / plan.units();
    const uint64_t picture = uint64_t(header.identity.width) * header.identity.height;
    const uint64_t most = std::min<uint64_t>(header.identity.height, 9999);
    plan.rows = uint32_t(
        std::clamp<uint64_t>(std::min(wanted, picture / std::max<uint64_t>(pixels, 1)), 1, most));
    const auto begun = begun_plan(store);
    if (begun && begun->samples == header.samples && begun->unit_samples == plan.unit_samples) {
        plan.columns = begun->columns;
        plan.rows = begun->rows;
    }
    return plan;
}

} // namespace onde
