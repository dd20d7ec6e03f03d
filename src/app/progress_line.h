// How far a render is: one line that is rewritten on a terminal, plain lines elsewhere.
#pragma once

#include "core/timer.h"
#include "render/render_loop.h"

#include <string>

namespace onde::app {

class ProgressLine {
  public:
    /// Writes to standard error, after the name of what is rendered; nothing when quiet.
    explicit ProgressLine(bool quiet, const std::string& name = {});

    void show(const Progress& progress);
    /// Ends the rewritten line.
    void finish();

  private:
    bool quiet_, terminal_;
    std::string name_; ///< with what stands between it and the numbers
    bool open_ = false;
    double next_plain_line_ = 5;
};

} // namespace onde::app
