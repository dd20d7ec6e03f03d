#include "farm/work.h"

#include "core/error.h"
#include "core/files.h"
#include "core/hash.h"
#include "core/timer.h"
#include "film/merge.h"
#include "film/region.h"

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <sstream>
#include <thread>

namespace onde {
namespace fs = std::filesystem;
namespace {

/// While it lives, a lease is held.
class Lease {
  public:
    Lease(const Store& store, std::string name)
        : store_(store), name_(std::move(name)), held_(store.claim(name_)) {}
    ~Lease() {
        if (held_) store_.release(name_);
    }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    explicit operator bool() const { return held_; }
    const std::string& name() const { return name_; }

  private:
    const Store& store_;
    std::string name_;
    bool held_;
};

std::string hash_of_file(const fs::path& path) {
    return Hasher().text(read_file(path)).hex();
}

std::string worker_name() {
    char host[256] = "";
    gethostname(host, sizeof(host) - 1);
    return fmt::format("{} ({})", host, getpid());
}

/// Throws InputError for a film of a store that can't be read, with what to do about it.
void check_film(const fs::path& path) try {
    FilmReader film(path);
    for (size_t part = 0; part < film.parts().size(); part++) film.check_part(part);
} catch (const InputError& problem) {
    throw InputError("{}: delete this file, and a worker does", problem.what());
}

FilmMerge merge_of(const std::vector<fs::path>& files) try {
    return FilmMerge(files);
} catch (const InputError&) {
    for (const fs::path& file : files) check_film(file);
    throw;
}

} // namespace

uint32_t WorkPlan::units() const {
    return (header.samples + unit_samples - 1) / unit_samples;
}

Rectangle WorkPlan::window(uint32_t tile) const {
    return tile_of({0, 0, header.identity.width, header.identity.height}, columns, rows, tile);
}

std::pair<uint32_t, uint32_t> WorkPlan::samples(uint32_t index) const {
    return {index * unit_samples, std::min((index + 1) * unit_samples, header.samples)};
}

static void check_plan(const WorkPlan& plan) {
    const uint32_t blocks = plan.unit_samples / FILM_BLOCK;
    if (plan.unit_samples % FILM_BLOCK != 0 || !std::has_single_bit(blocks))
        throw InputError("a unit of {} samples does not fit the tree; use 64, 128, 256, ...",
                         plan.unit_samples);
    if (plan.columns == 0 || plan.rows == 0 || plan.columns > plan.header.identity.width ||
        plan.rows > plan.header.identity.height || uint64_t(plan.columns) * plan.rows > 9999)
        throw InputError("{}x{} tiles do not fit a picture of {}x{}", plan.columns, plan.rows,
                         plan.header.identity.width, plan.header.identity.height);
}

/// The note of it in a store.
static constexpr const char* PLAN = "plan";

static std::string text_of(const WorkPlan& plan) {
    return fmt::format("{} samples in units of {}, {}x{} tiles", plan.header.samples,
                       plan.unit_samples, plan.columns, plan.rows);
}

/// As the first worker notes it, for the others: how it is cut, and of what picture it is.
static std::string note_of(const WorkPlan& plan) {
    std::string note = text_of(plan) + "\n";
    for (const auto& [key, value] : texts_of(plan.header)) note += key + "\n" + value + "\n";
    return note;
}

static FilmHeader header_of_note(const std::string& note) {
    std::istringstream lines(note.substr(std::min(note.size(), note.find('\n') + 1)));
    HeaderTexts texts;
    for (std::string key, value; std::getline(lines, key) && std::getline(lines, value);)
        texts[key] = value;
    return header_of(texts);
}

static void check_note(const std::string& note, const WorkPlan& plan, const std::string& store) {
    try {
        check_same(header_of_note(note), plan.header, store);
    } catch (const std::runtime_error& problem) {
        if (dynamic_cast<const InputError*>(&problem)) throw;
        throw InputError("{}: this store can't be read ({}); use another folder", store,
                         problem.what());
    }
    const std::string begun = note.substr(0, note.find('\n'));
    if (begun != text_of(plan))
        throw InputError("{}: this store was begun with {}, not with {}; use the same, or another "
                         "folder",
                         store, begun, text_of(plan));
}

void begin_plan(const Store& store, const WorkPlan& plan) {
    check_plan(plan);
    constexpr auto PAUSE = std::chrono::milliseconds(20);
    for (;;) {
        if (const auto note = store.get(PLAN))
            return check_note(*note, plan, store.film().parent_path().string());
        const Lease lease(store, PLAN); // the first one alone says what the store is of
        if (lease && !store.get(PLAN)) return store.put(PLAN, note_of(plan));
        if (!lease) std::this_thread::sleep_for(PAUSE);
    }
}

std::optional<BegunPlan> begun_plan(const Store& store) {
    BegunPlan plan;
    const auto text = store.get(PLAN);
    if (!text ||
        std::sscanf(text->c_str(), "%u samples in units of %u, %ux%u tiles", &plan.samples,
                    &plan.unit_samples, &plan.columns, &plan.rows) != 4 ||
        plan.unit_samples == 0)
        return std::nullopt;
    return plan;
}

Worker::Worker(const Store& store, WorkPlan plan, double verify, Render render)
    : store_(store), plan_(std::move(plan)), verify_(verify), render_(std::move(render)) {
    begin_plan(store_, plan_);
}

WorkState work_state(const Store& store) {
    const auto plan = begun_plan(store);
    if (!plan)
        throw InputError("{}: no worker has begun here; start one with onde work",
                         store.film().parent_path().string());
    WorkState state;
    const uint64_t of_tile =
        (uint64_t(plan->samples) + plan->unit_samples - 1) / plan->unit_samples;
    state.units = uint32_t(of_tile * plan->columns * plan->rows);
    std::error_code ignored;
    state.complete = fs::exists(store.film(), ignored);
    state.workers = store.count_leases();
    uint64_t done = state.complete ? state.units : 0;
    if (!state.complete)
        for (const StoreKey& key : store.list())
            done += std::min(of_tile, (uint64_t(key.index) + 1) << key.level) -
                    std::min(of_tile, uint64_t(key.index) << key.level);
    state.done = uint32_t(done);
    double seconds = 0;
    const std::vector<std::string> notes = store.notes(".done");
    for (const std::string& name : notes)
        seconds += std::strtod(store.get(name).value_or("0").c_str(), nullptr);
    if (!notes.empty()) state.seconds_a_unit = seconds / double(notes.size());
    return state;
}

/// By chance, but the same for all workers.
bool Worker::is_verified(uint32_t tile, uint32_t index) const {
    constexpr double WHOLE = 1 << 20;
    const uint64_t chance =
        Hasher().text(plan_.header.identity.scene).value(tile).value(index).digest() >> 44;
    return double(chance) < verify_ * WHOLE;
}

Worker::Step Worker::step() {
    std::error_code ignored;
    if (fs::exists(store_.film(), ignored)) {
        const FilmReader film(store_.film());
        check_same(film.header(), plan_.header, store_.film().string());
        if (film.header().samples == plan_.header.samples) {
            if (const auto step = verify_unit()) return *step;
            for (const StoreKey& key : store_.list()) store_.remove(key); // of who was late
            return Step::done;
        }
        throw InputError("{}: is a picture of {} samples, not of {}; choose another store",
                         store_.film().string(), film.header().samples, plan_.header.samples);
    }
    const std::vector<StoreKey> keys = store_.list();
    if (const auto step = join_pair(keys)) return *step;
    has_missing_ = false;
    if (const auto step = render_missing(keys)) return *step;
    return has_missing_ ? Step::waiting : finish(keys);
}

std::optional<Worker::Step> Worker::join_pair(const std::vector<StoreKey>& keys) {
    const std::set<StoreKey> there(keys.begin(), keys.end());
    for (const StoreKey& key : keys) {
        if (key.index % 2 != 0 || !there.contains(key.sibling())) continue;
        const uint64_t end = (uint64_t(key.parent().index) + 1) << key.parent().level;
        if (end * plan_.unit_samples > plan_.header.samples) continue; // the last one is shorter
        const Lease lease(store_, "join-" + name_of(key.parent()));
        if (!lease) continue;
        try {
            FilmMerge merge = merge_of({store_.path(key), store_.path(key.sibling())});
            check_same(merge.header(), plan_.header, store_.path(key).string());
            merge.write(store_.path(key.parent()));
        } catch (const InputError&) {
            std::error_code ignored; // done by another worker, whose lease this one took
            if (fs::exists(store_.path(key), ignored) &&
                fs::exists(store_.path(key.sibling()), ignored))
                throw;
            return Step::worked;
        }
        store_.remove(key);
        store_.remove(key.sibling());
        joined_++;
        return Step::worked;
    }
    return std::nullopt;
}

std::optional<Worker::Step> Worker::render_missing(const std::vector<StoreKey>& keys) {
    std::set<std::pair<uint32_t, uint32_t>> there; // tiles and units
    for (const StoreKey& key : keys)
        for (uint64_t i = uint64_t(key.index) << key.level;
             i < (uint64_t(key.index) + 1) << key.level && i < plan_.units(); i++)
            there.insert({key.tile, uint32_t(i)});
    for (uint32_t index = 0; index < plan_.units(); index++)
        for (uint32_t tile = 0; tile < plan_.tiles(); tile++) {
            if (there.contains({tile, index})) continue;
            has_missing_ = true;
            const StoreKey key{tile, 0, index};
            const Lease lease(store_, name_of(key));
            if (lease) return render_unit(key, lease.name());
        }
    return std::nullopt;
}

Worker::Step Worker::render_unit(const StoreKey& key, const std::string& lease) {
    const fs::path path = store_.path(key);
    const Timer timer;
    if (!render_(plan_.window(key.tile), plan_.samples(key.index), path,
                 [&] { store_.renew(lease); }))
        return Step::interrupted;
    if (is_verified(key.tile, key.index))
        store_.put(name_of(key) + ".first", hash_of_file(path) + " " + worker_name());
    store_.put(name_of(key) + ".done", fmt::format("{:.3f} {}", timer.seconds(), worker_name()));
    rendered_++;
    return Step::worked;
}

std::optional<Worker::Step> Worker::verify_unit() {
    for (uint32_t index = 0; index < plan_.units(); index++)
        for (uint32_t tile = 0; tile < plan_.tiles(); tile++) {
            if (!is_verified(tile, index)) continue;
            const std::string name = name_of({tile, 0, index});
            const auto first = store_.get(name + ".first");
            if (!first || store_.get(name + ".second")) continue;
            const Lease lease(store_, "verify-" + name);
            if (!lease) continue;
            const fs::path path = store_.film().parent_path() / "notes" / (name + ".exr");
            if (!render_(plan_.window(tile), plan_.samples(index), path,
                         [&] { store_.renew(lease.name()); }))
                return Step::interrupted;
            const std::string second = hash_of_file(path);
            std::error_code ignored;
            fs::remove(path, ignored);
            store_.put(name + ".second", second + " " + worker_name());
            if (!first->starts_with(second))
                throw InputError("samples {} to {} of tile {} have other bits when they are "
                                 "rendered again: {} by {}, then {} by {}; one of the machines has "
                                 "a fault",
                                 plan_.samples(index).first, plan_.samples(index).second - 1, tile,
                                 first->substr(0, 16), first->substr(17), second, worker_name());
            return Step::worked;
        }
    return std::nullopt;
}

Worker::Step Worker::finish(const std::vector<StoreKey>& keys) {
    const Lease lease(store_, "film");
    if (!lease) return Step::waiting;
    std::vector<fs::path> files;
    for (const StoreKey& key : keys) files.push_back(store_.path(key));
    try {
        FilmMerge merge = merge_of(files);
        check_same(merge.header(), plan_.header, files.front().string());
        if (!merge.missing().empty()) return Step::worked; // another worker is joining them
        merge.write(store_.film());
    } catch (const InputError&) {
        const auto is_there = [](const fs::path& file) {
            std::error_code ignored;
            return fs::exists(file, ignored);
        };
        if (std::ranges::all_of(files, is_there)) throw;
        return Step::worked; // another worker has joined them meanwhile
    }
    for (const StoreKey& key : keys) store_.remove(key);
    return Step::worked;
}

} // namespace onde
