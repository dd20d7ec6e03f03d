// The laboratory's tables and plot.
#pragma once

#include "chapter/laboratory.h"

#include <string>

namespace onde::app {

std::string lab_text(const LabReport& report);
std::string trials_text(const VolumeTrials& trials);

/// Bars as an SVG picture: what each volume rejects and costs, what each hierarchy tests and takes.
std::string lab_svg(const LabReport& report, const std::string& title);

} // namespace onde::app
