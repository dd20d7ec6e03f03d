// Triangles and spheres in bulk.
#pragma once

#include "doctor/soups.h"

namespace onde::test {

using doctor::bumpy_terrain;
using doctor::Generator;
using doctor::random_spheres;
using doctor::random_transform;
using doctor::random_triangles;
using doctor::Soup;
using doctor::uniform;
using doctor::uniform_point;

} // namespace onde::test
