// What `onde doctor` asks of a device: checks from the ground up, each with one number as answer.
#pragma once

#include "gpu/program.h"

#include <span>
#include <string>

namespace onde::doctor {

/// What the checks run on.
struct CheckContext {
    gpu::Programs& programs;
    bool quick = false; ///< fewer samples and variants

    const gpu::Device& device() const { return programs.device(); }
    const gpu::DeviceFacts& facts() const { return device().facts(); }
};

/// The answer of a check.
struct Finding {
    bool passed = false;
    double value = 0;   ///< how many of what was compared are wrong, or what `unit` says
    std::string unit{}; ///< for example "of 391 places differ"
    std::string text{}; ///< what more there is to say; of a check that failed what is wrong first
};

struct Check {
    const char* name;
    const char* words; ///< what it asks, for people
    Finding (*run)(const CheckContext&);
};

/// In the order in which they are made: what one relies on is checked before it, so that the first
/// that fails is nearest to the cause.
std::span<const Check> all_checks();

/// Makes the check. What it throws (kernels that do not compile, launches that fail) is a failure
/// with that sentence.
Finding examine(const Check& check, const CheckContext& context);

} // namespace onde::doctor
