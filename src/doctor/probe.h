// Kernel functions called one by one: kernels/probe maps them over arrays on the device.
#pragma once

#include "gpu/program.h"
#include "shared/items.h"

#include <bit>
#include <string>
#include <vector>

namespace onde::doctor {

/// Words by column: columns[k][i] is word k of item i.
using Columns = std::vector<std::vector<float>>;

/// An unsigned integer as a probe's input word, and back.
inline float word(uint32_t a) {
    return std::bit_cast<float>(a);
}
inline uint32_t from_word(float a) {
    return std::bit_cast<uint32_t>(a);
}

/// What a probe has not written is this.
inline constexpr float UNWRITTEN = -1234567.0f;

/// Some probes of a file of kernels/probe, compiled at one width.
class Probe {
  public:
    /// The programs outlive it.
    Probe(gpu::Programs& programs, const std::string& file, uint32_t width,
          const std::vector<std::string>& names, std::vector<std::string> defines = {},
          std::vector<std::string> before = {})
        : device_(programs.device()),
          program_(
              programs.build(request(file, width, names, std::move(defines), std::move(before)))) {}

    /// All `words` output columns that probe `name` writes, over the items of `in`, which has at
    /// least one column. `bind` sets the arguments between `count` and the columns and returns the
    /// next.
    template <class Bind>
    Columns run(const std::string& name, const Columns& in, size_t words, const Bind& bind) {
        const size_t items = in[0].size(),
                     padded = (items + PROBE_ITEMS - 1) / PROBE_ITEMS * PROBE_ITEMS;
        std::vector<float> flat;
        flat.reserve(in.size() * padded);
        for (const std::vector<float>& column : in) {
            flat.insert(flat.end(), column.begin(), column.end());
            flat.insert(flat.end(), padded - items, column.back());
        }
        const gpu::Buffer<float> input(device_, std::span<const float>(flat));
        gpu::Buffer<float> output(device_, words * padded);
        output.fill(device_, UNWRITTEN);
        gpu::Kernel& kernel = program_.kernel("probe_" + name);
        kernel.set(0, uint32_t(padded));
        kernel.set_from(bind(kernel, 1u), input, output);
        kernel.launch(padded / PROBE_ITEMS);
        const std::vector<float> all = output.read(device_);
        Columns out;
        for (size_t k = 0; k < words; k++) {
            const auto column = all.begin() + ptrdiff_t(k * padded);
            out.emplace_back(column, column + ptrdiff_t(items));
        }
        return out;
    }
    Columns run(const std::string& name, const Columns& in, size_t words) {
        return run(name, in, words, [](gpu::Kernel&, uint32_t next) { return next; });
    }

  private:
    static gpu::ProgramRequest request(const std::string& file, uint32_t width,
                                       const std::vector<std::string>& names,
                                       std::vector<std::string> defines,
                                       std::vector<std::string> before) {
        defines.push_back(fmt::format("ONDE_WIDTH={}", width));
        gpu::ProgramRequest request{"probe/" + file, std::move(defines), {}, std::move(before)};
        for (const std::string& name : names) request.kernels.push_back({"probe_" + name, 1});
        return request;
    }

    const gpu::Device& device_;
    gpu::Program program_;
};

} // namespace onde::doctor
