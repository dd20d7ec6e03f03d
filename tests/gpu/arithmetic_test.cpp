// The arithmetic that our kernels rely on, bit by bit against the host's IEEE 754: with
// `#pragma OPENCL FP_CONTRACT OFF` a * b + c is rounded twice, fma() once, and sqrt and division
// are correctly rounded; for float and for float16.
#include "gpu/program.h"
#include "gpu/temporary_folder.h"

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <random>

using namespace onde;
using namespace onde::gpu;

namespace {

constexpr size_t LANES = 16, COUNT = 4096 * LANES;

const char* const KERNELS = R"(
#pragma OPENCL FP_CONTRACT OFF
#define KERNEL(name, expression)                                                                   \
    __kernel void name(uint count, __global const T* as, __global const T* bs,                     \
                       __global const T* cs, __global T* out) {                                    \
        const size_t i = get_global_id(0);                                                         \
        if (i >= count) return;                                                                    \
        const T a = as[i], b = bs[i], c = cs[i];                                                   \
        out[i] = expression;                                                                       \
    }
KERNEL(multiply_add, a * b + c)
KERNEL(multiply_subtract, a * b - c)
KERNEL(fused, fma(a, b, c))
KERNEL(square_root, sqrt(fabs(a) + 0.0f * (b + c)))
KERNEL(divide, a / b + 0.0f * c)
)";

/// Three numbers for each place; products that nearly cancel the sum make double rounding show.
struct Numbers {
    std::vector<float> a, b, c;
};

Numbers random_numbers() {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> mantissa(1.0f, 2.0f), near(0.999999f, 1.000001f);
    std::uniform_int_distribution<int> exponent(-20, 20);
    const auto number = [&] { return std::ldexp(mantissa(random), exponent(random)); };
    Numbers numbers;
    for (size_t i = 0; i < COUNT; ++i) {
        numbers.a.push_back(number());
        numbers.b.push_back(i % 2 ? -number() : number());
        numbers.c.push_back(-numbers.a[i] * numbers.b[i] * near(random));
    }
    return numbers;
}

// Results through volatile, so that the host's compiler cannot contract either.
float multiply_add(float a, float b, float c) {
    const volatile float product = a * b;
    return product + c;
}

class Arithmetic {
  public:
    /// `type` is "float" or "float16".
    explicit Arithmetic(const std::string& type) : lanes_(type == "float" ? 1 : LANES) {
        folder_.write("arithmetic.cl", KERNELS);
        Programs programs(device_, KernelSources::folder(folder_.path()));
        program_.emplace(programs.build(
            {"arithmetic.cl",
             {"T=" + type},
             {{"multiply_add"}, {"multiply_subtract"}, {"fused"}, {"square_root"}, {"divide"}}}));
    }

    /// The number of places at which kernel and host differ in any bit.
    template <class Host>
    size_t differences(const std::string& kernel, const Numbers& numbers, Host&& host) {
        const Buffer<float> a(device_, numbers.a), b(device_, numbers.b), c(device_, numbers.c);
        const Buffer<float> out(device_, COUNT);
        program_->kernel(kernel).set_from(0, uint32_t(COUNT / lanes_), a, b, c, out);
        program_->kernel(kernel).launch(COUNT / lanes_);
        const std::vector<float> results = out.read(device_);
        size_t count = 0;
        for (size_t i = 0; i < COUNT; ++i) {
            const float expected = host(numbers.a[i], numbers.b[i], numbers.c[i]);
            count += std::bit_cast<uint32_t>(results[i]) != std::bit_cast<uint32_t>(expected);
        }
        return count;
    }

    bool rounds_correctly() const { return device_.facts().correctly_rounded_divide_sqrt; }

  private:
    test::TemporaryFolder folder_;
    Device device_ = open_device();
    size_t lanes_;
    std::optional<Program> program_;
};

} // namespace

TEST_CASE("the numbers tell one rounding from two") {
    const Numbers numbers = random_numbers();
    size_t differ = 0;
    for (size_t i = 0; i < COUNT; ++i)
        differ += multiply_add(numbers.a[i], numbers.b[i], numbers.c[i]) !=
                  std::fma(numbers.a[i], numbers.b[i], numbers.c[i]);
    CHECK(differ > COUNT / 2);
}

TEST_CASE("with FP_CONTRACT OFF a * b + c is not contracted, in float and in float16") {
    const Numbers numbers = random_numbers();
    for (const char* type : {"float", "float16"}) {
        INFO(type);
        Arithmetic arithmetic(type);
        CHECK(arithmetic.differences("multiply_add", numbers, multiply_add) == 0);
        CHECK(arithmetic.differences("multiply_subtract", numbers, [](float a, float b, float c) {
            return multiply_add(a, b, -c);
        }) == 0);
    }
}

TEST_CASE("fma rounds once, in float and in float16") {
    const Numbers numbers = random_numbers();
    for (const char* type : {"float", "float16"}) {
        INFO(type);
        Arithmetic arithmetic(type);
        CHECK(arithmetic.differences("fused", numbers, [](float a, float b, float c) {
            return std::fma(a, b, c);
        }) == 0);
    }
}

TEST_CASE("square roots and quotients are correctly rounded, in float and in float16") {
    const Numbers numbers = random_numbers();
    for (const char* type : {"float", "float16"}) {
        INFO(type);
        Arithmetic arithmetic(type);
        if (!arithmetic.rounds_correctly()) {
            WARN("skipped: this device does not promise correct rounding");
            return;
        }
        CHECK(arithmetic.differences("square_root", numbers, [](float a, float, float) {
            return std::sqrt(std::fabs(a));
        }) == 0);
        CHECK(arithmetic.differences("divide", numbers,
                                     [](float a, float b, float) { return a / b; }) == 0);
    }
}
