// From what other formats state of surfaces, indices and alphas, to what our materials have.
#pragma once

#include "scene/material.h"

namespace onde {

/// The share of diffuse light from within a dielectric of that index that its smooth surface sends
/// back, by Fresnel's equations.
double internal_reflectance(double index);

/// A body under a coat of that index, between whose inside and itself light goes to and fro: what
/// other formats call a plastic.
void set_plastic(Material& material, double index);

/// A pane of that index, a slab whose faces are parallel.
void set_pane(Material& material, double index);

/// Fills what a material's closed surface encloses. One that lets rays pass altogether becomes the
/// boundary of the medium. False where no light gets in.
bool fill(Material& material, const Medium& medium);

/// What a conductor of that complex index reflects, under a cosine.
double conductor_reflectance(double cosine, double eta, double k);
/// How far that is at 82 degrees, where cosines are 1/7, from what Schlick's formula says.
double edge_tint(double eta, double k);

/// Microfacets whose alphas along u and along v are these, in [0, 1].
void set_alphas(Material& material, double u, double v);

} // namespace onde
