// Directional albedos of microfacets, GGX's where nothing else is said, by quadrature: how much of
// the light from one direction they scatter when each ray meets one of them. cosine, of the
// direction and the surface's normal, and alpha lie in (0, 1].
#pragma once

#include "scene/material.h"

namespace onde {

/// What microfacets reflect: the albedo of a white surface, and its part that Schlick's weight
/// (1 - cosine)^5 counts. Absolute errors below 0.0005.
struct ReflectionAlbedo {
    double white, grazing;
};
ReflectionAlbedo reflection_albedo(double cosine, double alpha,
                                   Distribution distribution = Distribution::ggx);

/// The same of microfacets with a grain: alpha_x along it, alpha_y across; `along` is the cosine of
/// the direction's azimuth from the grain. Absolute errors below 0.003.
ReflectionAlbedo grain_albedo(double cosine, double along, double alpha_x, double alpha_y);
ReflectionAlbedo beckmann_grain_albedo(double cosine, double along, double alpha_x, double alpha_y);

/// What white fibres scatter: those of kernels/shade/lobes/sheen.h.
double sheen_albedo(double cosine, double alpha);

/// What a boundary of clear glass reflects and refracts in sum, of light from outside and of light
/// from inside; ior: the index of refraction inside over that outside. Absolute errors below 0.004.
struct GlassAlbedo {
    double outside, inside;
};
GlassAlbedo glass_albedo(double cosine, double alpha, double ior,
                         Distribution distribution = Distribution::ggx);

} // namespace onde
