// Collects what a loader mapped or ignored, one sentence for each kind of thing.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace onde {

/// Repeated notes are counted instead of repeated: "alpha is ignored (leaf and 2 more)".
class Notes {
  public:
    Notes() = default;
    /// Notes about `file`; strict ones refuse what is wrong.
    Notes(std::string file, bool strict) : file_(std::move(file)), strict_(strict) {}

    /// What Onde maps or does not have, though the file is right. `sentence` starts with a capital
    /// and ends without a stop; `example` names one case of it.
    void add(const std::string& sentence, const std::string& example = {});

    /// What is wrong with the file and was repaired or dropped. Strict notes throw it as an
    /// InputError.
    void wrong(const std::string& sentence, const std::string& example = {});

    /// The sentences in the order in which each was first added.
    std::vector<std::string> sentences() const;

  private:
    struct Entry {
        std::string sentence, example;
        size_t count = 0;
    };
    std::string file_;
    bool strict_ = false;
    std::vector<Entry> entries_;
    std::map<std::string, size_t> index_;
};

} // namespace onde
