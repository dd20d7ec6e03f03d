// The ways in which an engine can be driven, all of which must make the same bits.
#pragma once

#include "doctor/variants.h"

namespace onde::test {

using doctor::apply;
using doctor::first_difference;
using doctor::Variant;
using doctor::VARIANTS;

} // namespace onde::test
