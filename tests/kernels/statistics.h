// Pearson's chi-square test and stratification.
#pragma once

#include "doctor/statistics.h"

namespace onde::test {

using doctor::chi_square_failure;
using doctor::chi_square_tail;
using doctor::find_uneven_interval;
using doctor::Points;
using doctor::SphereBins;

} // namespace onde::test
