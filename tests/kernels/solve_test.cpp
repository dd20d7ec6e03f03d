// The chapter's linear systems (C11) on the device, against its worked example, against double
// precision, and where there is no solution.
#include "kernels/columns.h"

#include <catch2/catch.hpp>

using namespace onde::test;

namespace {

constexpr std::array<uint32_t, 3> WIDTHS{1, 8, 16};
constexpr std::array SOLVERS{"inverse matrix", "Gaussian elimination", "Cramer's rule"};

struct Systems {
    std::vector<glm::vec3> a, b, c, right;

    void add(const glm::mat3& columns, glm::vec3 r) {
        a.push_back(columns[0]);
        b.push_back(columns[1]);
        c.push_back(columns[2]);
        right.push_back(r);
    }
    size_t size() const { return right.size(); }
    glm::dmat3 matrix(size_t i) const {
        return {glm::dvec3(a[i]), glm::dvec3(b[i]), glm::dvec3(c[i])};
    }
    Columns columns() const {
        Columns all;
        for (const auto* vectors : {&a, &b, &c, &right}) add_vectors(all, *vectors);
        return all;
    }
};

/// -2x + 4y - z = 10, x + 3z = 3, x - 2y + 3z = 4.
Systems worked_example() {
    Systems systems;
    systems.add(glm::mat3(-2, 1, 1, 4, 0, -2, -1, 3, 3), {10, 3, 4});
    return systems;
}

Columns solve(const Systems& systems, uint32_t width) {
    return Probe("solve.cl", width, {"solve"}).run("solve", systems.columns(), 12);
}

glm::vec3 vector(Generator& generator, float size = 1) {
    const auto number = [&] { return size * (2 * unit(generator) - 1); };
    const float x = number(), y = number(), z = number();
    return {x, y, z};
}

double largest(const glm::dmat3& m) {
    double norm = 0;
    for (int row = 0; row < 3; row++)
        norm = std::max(norm, std::abs(m[0][row]) + std::abs(m[1][row]) + std::abs(m[2][row]));
    return norm;
}

} // namespace

TEST_CASE("the chapter's worked example has its determinants") {
    const Systems systems = worked_example();
    const glm::vec3 a = systems.a[0], b = systems.b[0], c = systems.c[0], r = systems.right[0];
    Columns columns;
    add_vectors(columns, {a, r, a, a});
    add_vectors(columns, {b, b, r, b});
    add_vectors(columns, {c, c, c, r});
    for (uint32_t width : WIDTHS) {
        const Columns out =
            Probe("solve.cl", width, {"determinant"}).run("determinant", columns, 1);
        CHECK(out[0] == Column{-10, 78, 5, -36});
    }
}

TEST_CASE("the chapter's worked example is solved by each of the three") {
    const glm::dvec3 expected(-39.0 / 5, -1.0 / 2, 18.0 / 5);
    for (uint32_t width : WIDTHS) {
        const Columns out = solve(worked_example(), width);
        for (size_t k = 0; k < 3; k++) {
            INFO(SOLVERS[k] << " at width " << width);
            CHECK(out[4 * k + 3][0] == 1);
            CHECK(glm::length(vector_at(out, 4 * k, 0) - expected) < 2e-6);
        }
    }
}

TEST_CASE("singular systems are reported and not divided by") {
    Systems systems;
    systems.add(glm::mat3(0.0f), {1, 2, 3});
    systems.add(glm::mat3(1, 2, 3, 2, 4, 6, 7, 8, 9), {1, 2, 3});   // two parallel columns
    systems.add(glm::mat3(1, 4, 7, 2, 5, 8, 3, 6, 9), {1, 0, 0});   // rank two
    systems.add(glm::mat3(0, 0, 0, 1, 2, 3, 3, 1, 2), {1, 1, 1});   // no x
    systems.add(glm::mat3(NAN, 0, 0, 0, 1, 0, 0, 0, 1), {1, 1, 1}); // not a number
    systems.add(glm::mat3(.1f, .2f, .3f, .3f, .6f, .9f, 1, 0, 1), {1, 1, 1}); // by rounding only
    Generator generator(1);
    for (int i = 0; i < 1000; i++) {
        const glm::vec3 a = vector(generator), b = vector(generator);
        const float s = unit(generator), t = unit(generator);
        systems.add(glm::mat3(a, b, s * a + t * b), vector(generator)); // in one plane
    }
    for (uint32_t width : WIDTHS) {
        const Columns out = solve(systems, width);
        for (size_t i = 0; i < systems.size(); i++)
            for (size_t k = 0; k < 3; k++) {
                INFO("item " << i << " by " << SOLVERS[k] << " at width " << width);
                CHECK(out[4 * k + 3][i] == 0);
                CHECK(vector_at(out, 4 * k, i) == glm::dvec3(0));
            }
    }
}

TEST_CASE("tiny and huge regular systems are not taken for singular ones") {
    Systems systems;
    for (float scale : {1e-10f, 1e-3f, 1e3f, 1e10f}) {
        systems.add(scale * glm::mat3(2, 0, 0, 0, 3, 0, 0, 0, 4), scale * glm::vec3(2, 3, 4));
        systems.add(glm::mat3(scale, 0, 0, 0, 1, 0, 0, 0, 1), {scale, 1, 1});
        systems.add(glm::mat3(0, 1, 0, 0, 0, 1, scale, 0, 0), {scale, 1, 1}); // needs pivots
    }
    for (uint32_t width : WIDTHS) {
        const Columns out = solve(systems, width);
        for (size_t i = 0; i < systems.size(); i++)
            for (size_t k = 0; k < 3; k++) {
                INFO("item " << i << " by " << SOLVERS[k] << " at width " << width);
                CHECK(out[4 * k + 3][i] == 1);
                CHECK(glm::length(vector_at(out, 4 * k, i) - glm::dvec3(1)) < 1e-6);
            }
    }
}

TEST_CASE("random systems are solved as in double precision, to rounding") {
    Generator generator(2);
    Systems systems;
    for (int i = 0; i < 100000; i++)
        systems.add(glm::mat3(vector(generator), vector(generator), vector(generator)),
                    vector(generator));
    for (uint32_t width : WIDTHS) {
        const Columns out = solve(systems, width);
        for (size_t k = 0; k < 3; k++) {
            INFO(SOLVERS[k] << " at width " << width);
            // Relative to what rounding the input alone may do: the condition number.
            const auto error = [&](size_t i) {
                const glm::dmat3 m = systems.matrix(i), inverse = glm::inverse(m);
                const glm::dvec3 exact = inverse * glm::dvec3(systems.right[i]);
                const double condition = largest(m) * largest(inverse);
                if (out[4 * k + 3][i] == 0) return condition > 1e5 ? 0.0 : double(NAN);
                return glm::length(vector_at(out, 4 * k, i) - exact) /
                       ((glm::length(exact) + largest(inverse)) * condition);
            };
            CHECK(worst_item(systems.size(), 1e-6, error, [&](size_t i) {
                      const glm::dvec3 x = vector_at(out, 4 * k, i);
                      const glm::dvec3 exact =
                          glm::inverse(systems.matrix(i)) * glm::dvec3(systems.right[i]);
                      return fmt::format("{} {} {} instead of {} {} {}", x.x, x.y, x.z, exact.x,
                                         exact.y, exact.z);
                  }) == "");
        }
    }
}

TEST_CASE("every width solves with the same bits") {
    Generator generator(3);
    Systems systems;
    for (int i = 0; i < 1000; i++)
        systems.add(glm::mat3(vector(generator), vector(generator), vector(generator)),
                    vector(generator));
    const Columns narrow = solve(systems, 1);
    CHECK(first_bit_difference(solve(systems, 8), narrow) == "");
    CHECK(first_bit_difference(solve(systems, 16), narrow) == "");
}

TEST_CASE("a ray meets a triangle where double precision says, by each solver") {
    constexpr size_t COUNT = 100000;
    Generator generator(4);
    std::vector<glm::vec3> origin, direction, a, ab, ac;
    for (size_t i = 0; i < COUNT; i++) {
        origin.push_back(vector(generator, 2));
        direction.push_back(vector(generator));
        a.push_back(vector(generator));
        ab.push_back(vector(generator));
        ac.push_back(vector(generator));
    }
    Columns in;
    for (const auto* vectors : {&origin, &direction, &a, &ab, &ac}) add_vectors(in, *vectors);
    for (uint32_t width : WIDTHS) {
        const Columns out =
            Probe("solve.cl", width, {"solve_triangle"}).run("solve_triangle", in, 15);
        for (size_t k = 0; k < 3; k++) {
            size_t wrong = 0, triangles = 0, parallelograms = 0;
            for (size_t i = 0; i < COUNT; i++) {
                const glm::dmat3 m(-glm::dvec3(direction[i]), glm::dvec3(ab[i]), glm::dvec3(ac[i]));
                const glm::dvec3 x = glm::inverse(m) * (glm::dvec3(origin[i]) - glm::dvec3(a[i]));
                const double margin = std::min({x.y, x.z, 1 - x.y - x.z});
                const double wide = std::min({x.y, x.z, 1 - x.y, 1 - x.z});
                triangles += out[5 * k + 4][i] != 0;
                parallelograms += out[5 * k + 3][i] != 0;
                if (std::abs(margin) > 1e-3) wrong += (out[5 * k + 4][i] != 0) != (margin > 0);
                if (std::abs(wide) > 1e-3) wrong += (out[5 * k + 3][i] != 0) != (wide > 0);
            }
            INFO(SOLVERS[k] << " at width " << width);
            CHECK(wrong == 0);
            CHECK(triangles > COUNT / 100);
            CHECK(parallelograms > 3 * triangles / 2);
        }
    }
}

TEST_CASE("u + v <= 1 matters: half of the parallelogram is not the triangle") {
    const std::vector<glm::vec3> origin{{0.25f, 0.25f, 1},
                                        {0.75f, 0.75f, 1},
                                        {0.5f, 0.5f, 1},
                                        {1.25f, 0.25f, 1},
                                        {-.25f, 0.25f, 1}};
    const size_t count = origin.size();
    Columns in;
    add_vectors(in, origin);
    for (glm::vec3 v : {glm::vec3(0, 0, -1), glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)})
        add_vectors(in, std::vector<glm::vec3>(count, v));
    for (uint32_t width : WIDTHS) {
        const Columns out =
            Probe("solve.cl", width, {"solve_triangle"}).run("solve_triangle", in, 15);
        for (size_t k = 0; k < 3; k++) {
            INFO(SOLVERS[k] << " at width " << width);
            CHECK(out[5 * k + 3] == Column{1, 1, 1, 0, 0});
            CHECK(out[5 * k + 4] == Column{1, 0, 1, 0, 0});
            CHECK(out[5 * k] == Column(count, 1.0f));
        }
    }
}

TEST_CASE("a ray in a triangle's plane is a singular system and no hit") {
    Columns in;
    for (glm::vec3 v : {glm::vec3(-1, 0.2f, 0), glm::vec3(1, 0, 0), glm::vec3(0),
                        glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)})
        add_vectors(in, {v});
    for (uint32_t width : WIDTHS) {
        const Columns out =
            Probe("solve.cl", width, {"solve_triangle"}).run("solve_triangle", in, 15);
        for (size_t k = 0; k < 15; k++) CHECK(out[k][0] == 0);
    }
}
