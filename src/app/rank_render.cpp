#include "app/rank_render.h"

#include "app/film_request.h"
#include "app/unit_renderer.h"

#include "core/error.h"
#include "core/log.h"
#include "farm/rank_work.h"

#include <sstream>

namespace onde::app {
namespace {

namespace fs = std::filesystem;

constexpr double NO_LEASES = 1e9; // seconds; no rank takes another's unit

/// Throws InputError where a rank would add samples with other bits, or of another picture.
void check_same_job(Ranks& ranks, const FilmHeader& header) {
    std::string text;
    for (const auto& [key, value] : texts_of(header)) text += key + "\n" + value + "\n";
    const std::string first = ranks.broadcast(text);
    HeaderTexts texts;
    std::istringstream lines(first);
    for (std::string key, value; std::getline(lines, key) && std::getline(lines, value);)
        texts[key] = value;
    check_same(header_of(texts), header, fmt::format("rank 0, seen from rank {}", ranks.rank()));
}

} // namespace

void check_mpi_request(const RenderRequest& r) {
    if (!r.mpi) {
        if (!r.parts.empty()) throw InputError("--parts is of --mpi; give both");
        return;
    }
    if (is_sequence(r))
        throw InputError("--mpi is of one picture; give each frame a job of its own");
    if (!r.resume.empty() || r.checkpoint || !r.sample_range.empty() || !r.rectangle.empty() ||
        r.choices.seconds || r.choices.noise.value_or(0) > 0 || r.stats || !r.json.empty())
        throw InputError("ranks share out samples and pixels by themselves, and go on from their "
                         "parts; leave out --resume, --checkpoint, --samples, --rectangle, --time, "
                         "--noise, --stats and --json");
    for (const fs::path& output : r.outputs)
        if (is_standard_output(output))
            throw InputError("the output of ranks can't go to standard output, which mpirun joins; "
                             "name a file with -o");
}

fs::path parts_folder(const RenderRequest& request) {
    if (!request.parts.empty()) return request.parts;
    fs::path beside = film_path(request);
    if (beside.empty()) beside = named_outputs(request).front();
    return beside.string() + ".parts";
}

Machines open_machine_of_rank(const RenderRequest& request, const Ranks& ranks) {
    Machines all = open_machines(request, gpu::Profiling::off);
    Machines own;
    own.push_back(std::move(all.at(ranks.local_rank() % all.size())));
    return own;
}

bool render_by_ranks(Session& session, const RenderRequest& request, Ranks& ranks,
                     const StopOnInterrupt& interrupt) {
    const RenderOptions picture = session.options();
    RenderRequest quiet = request;
    quiet.quiet = request.quiet || ranks.rank() > 0;
    UnitRenderer renderer(session, quiet, interrupt);
    if (renderer.header().identity.has_ids())
        throw InputError(
            "the ranks of --mpi don't join the ids of --aov crypto-object and its like; "
            "leave them out, or share out the work by onde work");
    check_same_job(ranks, renderer.header());
    const Store store(parts_folder(request), NO_LEASES);
    const uint64_t pixels =
        uint64_t(picture.settings.wave_size) / std::max(picture.samples_in_flight, 1u);
    RankWork work(ranks, store, plan_for_ranks(store, renderer.header(), ranks.count(), pixels),
                  [&](const Rectangle& window, std::pair<uint32_t, uint32_t> samples,
                      const fs::path& file, const std::function<void()>& renew) {
                      return renderer.render(window, samples, file, renew);
                  });
    const std::optional<KeptFilm> film = work.run();
    spdlog::info("rank {} of {} has rendered {} units", ranks.rank(), ranks.count(),
                 work.rendered());
    session.set_options(picture);
    if (film && ranks.rank() == 0) session.restore_film(*film);
    return !film;
}

void remove_parts(const RenderRequest& request) {
    Store(parts_folder(request), NO_LEASES).remove_all();
}

} // namespace onde::app
