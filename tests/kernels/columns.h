// Inputs for probes, and comparisons of their outputs that name the worst item.
#pragma once

#include "doctor/columns.h"
#include "support/probe.h"

namespace onde::test {

using doctor::add_vectors;
using doctor::Column;
using doctor::constant_column;
using doctor::first_bit_difference;
using doctor::Generator;
using doctor::uniform_column;
using doctor::unit;
using doctor::unit_vector;
using doctor::unit_vectors;
using doctor::vector_at;
using doctor::word_column;
using doctor::worst_difference;
using doctor::worst_item;
using doctor::worst_ratio;

} // namespace onde::test
