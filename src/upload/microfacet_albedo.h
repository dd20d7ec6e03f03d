// Directional albedos of GGX microfacets, by quadrature: how much of the light from one direction
// they scatter when each ray meets one of them.
#pragma once

namespace onde {

/// What microfacets reflect: the albedo of a white surface, and its part that Schlick's weight
/// (1 - cosine)^5 counts. cosine, of the direction and the surface's normal, and alpha in (0, 1].
/// Absolute errors below 0.001.
struct ReflectionAlbedo {
    double white, grazing;
};
ReflectionAlbedo reflection_albedo(double cosine, double alpha);

/// What a boundary of clear glass reflects and refracts in sum, likewise; eta: the index beyond the
/// boundary over that before it. Absolute errors below 0.01.
double glass_albedo(double cosine, double alpha, double eta);

} // namespace onde
