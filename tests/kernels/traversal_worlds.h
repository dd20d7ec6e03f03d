// The worlds that traversal tests share, and the rays that they send.
#pragma once

#include "doctor/traversal_worlds.h"
#include "kernels/traversal_rig.h"

namespace onde::test::traversal {

using doctor::traversal::grove;
using doctor::traversal::join;
using doctor::traversal::mixed_world;
using doctor::traversal::needles;
using doctor::traversal::pinhole_rays;
using doctor::traversal::random_rays;
using doctor::traversal::varied_rays;

} // namespace onde::test::traversal
