// Probes of kernels on the tests' device.
#pragma once

#include "doctor/probe.h"
#include "support/programs.h"

namespace onde::test {

using doctor::Columns;
using doctor::from_word;
using doctor::UNWRITTEN;
using doctor::word;

/// A doctor::Probe. Tests keep them in statics, so they are never released, as the device isn't.
class Probe {
  public:
    Probe(const std::string& file, uint32_t width, const std::vector<std::string>& names,
          std::vector<std::string> defines = {}, std::vector<std::string> before = {})
        : probe_(*new doctor::Probe(programs(), file, width, names, std::move(defines),
                                    std::move(before))) {}

    template <class Bind>
    Columns run(const std::string& name, const Columns& in, size_t words, const Bind& bind) {
        return probe_.run(name, in, words, bind);
    }
    Columns run(const std::string& name, const Columns& in, size_t words) {
        return probe_.run(name, in, words);
    }

    doctor::Probe& own() { return probe_; }

  private:
    doctor::Probe& probe_;
};

} // namespace onde::test
