#include "mpi/mpi_ranks.h"

#include <mpi.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <vector>

namespace onde {
namespace {

constexpr int SUMS = 1; // the tag

/// An MPI call counts in int: calls part(first, count) with parts of the floats.
void for_each_message(size_t floats, const std::function<void(size_t, int)>& part) {
    constexpr size_t MOST = size_t(1) << 28;
    for (size_t first = 0; first < floats; first += MOST)
        part(first, int(std::min(MOST, floats - first)));
}

// Errors of MPI end all ranks, with its own message, as it does by default.
class MpiRanks final : public Ranks {
  public:
    MpiRanks() {
        MPI_Init(nullptr, nullptr);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &count_);
        MPI_Comm machine{};
        MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
        MPI_Comm_rank(machine, &local_);
        MPI_Comm_free(&machine);
    }

    uint32_t rank() const override { return uint32_t(rank_); }
    uint32_t count() const override { return uint32_t(count_); }
    uint32_t local_rank() const override { return uint32_t(local_); }

    void send(uint32_t to, FilmSums sums) override {
        constexpr size_t MOST_ON_THE_WAY = 2;
        while (on_the_way_.size() >= MOST_ON_THE_WAY) wait_for_oldest();
        Message& message = on_the_way_.emplace_back();
        message.sums = std::move(sums);
        const float* floats = message.sums.empty() ? nullptr : message.sums.front().s;
        for_each_message(4 * message.sums.size(), [&](size_t first, int number) {
            MPI_Isend(floats + first, number, MPI_FLOAT, int(to), SUMS, MPI_COMM_WORLD,
                      &message.requests.emplace_back());
        });
    }

    FilmSums receive(uint32_t from, size_t count) override {
        FilmSums sums(count);
        float* floats = sums.empty() ? nullptr : sums.front().s;
        for_each_message(4 * count, [&](size_t first, int number) {
            MPI_Recv(floats + first, number, MPI_FLOAT, int(from), SUMS, MPI_COMM_WORLD,
                     MPI_STATUS_IGNORE);
        });
        return sums;
    }

    std::string broadcast(const std::string& text) override {
        uint64_t size = text.size();
        MPI_Bcast(&size, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
        std::string all = text;
        all.resize(size);
        MPI_Bcast(all.data(), int(size), MPI_CHAR, 0, MPI_COMM_WORLD);
        return all;
    }

    void finish() override {
        while (!on_the_way_.empty()) wait_for_oldest();
        MPI_Barrier(MPI_COMM_WORLD);
        MPI_Finalize();
    }

  private:
    struct Message {
        FilmSums sums;
        std::vector<MPI_Request> requests;
    };

    void wait_for_oldest() {
        std::vector<MPI_Request>& requests = on_the_way_.front().requests;
        MPI_Waitall(int(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
        on_the_way_.pop_front();
    }

    int rank_ = 0, count_ = 1, local_ = 0;
    std::deque<Message> on_the_way_; ///< whose places do not change while they are
};

} // namespace

std::unique_ptr<Ranks> join_mpi_job() {
    return std::make_unique<MpiRanks>();
}

} // namespace onde
