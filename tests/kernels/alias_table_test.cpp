// Tables from which an entry is drawn by its weight with one number.
#include "kernels/columns.h"
#include "upload/alias_table.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::test;

TEST_CASE("an alias table gives every entry the probability of its weight") {
    Generator generator(72);
    for (size_t count : {1u, 2u, 7u, 1000u}) {
        std::vector<double> weights(count);
        for (double& w : weights) w = generator() % 4 ? std::pow(double(unit(generator)), 8) : 0.0;
        weights[count / 2] = 3;
        double total = 0;
        for (double w : weights) total += w;
        const std::vector<AliasEntry> table = build_alias_table(weights);
        std::vector<double> share(count);
        for (size_t i = 0; i < count; i++) {
            share[i] += double(table[i].below) / double(count);
            share[table[i].alias] += (1 - double(table[i].below)) / double(count);
        }
        for (size_t i = 0; i < count; i++) {
            REQUIRE(share[i] == Approx(weights[i] / total).margin(1e-7));
            REQUIRE(double(table[i].pmf) == Approx(weights[i] / total).epsilon(1e-6));
            if (weights[i] == 0) REQUIRE(share[i] == 0);
        }
    }
}

TEST_CASE("weights that are all zero are taken as equal") {
    for (const AliasEntry& record : build_alias_table(std::vector<double>(4, 0.0)))
        CHECK(record.pmf == 0.25f);
}
