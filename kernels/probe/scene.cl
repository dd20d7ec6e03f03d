// Probes of what reads the scene: textures, environment, lights, camera.
#include "probe/scene_probe.h"
#include "shade/camera_link.h"
#include "shade/light.h"
#include "trace/trace.h"

// In: texture, uv (2). Out: as data (3), as colour (3), alpha.
SCENE_PROBE(texture) {
    const natural texture = input_natural(items, 0);
    output(items, 0, texture_data(view, texture, same_in_all_sets(input2(items, 1))));
    output(items, 3, texture_color(view, texture, same_in_all_sets(input2(items, 1))));
    output(items, 6, texture_alpha(view, texture, same_in_all_sets(input2(items, 1))));
}

#if ONDE_ENVIRONMENT
// In: direction (3), u (2), which tables. Out: place on the map (2), the direction of that place
// (3), radiance (3) and pdf of the direction; the direction sampled by u (3).
SCENE_PROBE(environment) {
    const real3 direction = input3(items, 0);
    const real2 uv = environment_uv(view, direction);
    output(items, 0, uv);
    output(items, 2, environment_direction(view, uv));
    const uint which = input_uniform(items, 5);
    const FarLight far = environment_look(view, direction, which);
    output(items, 5, far.radiance);
    output(items, 8, far.pdf);
    output(items, 9, environment_sample(view, input2(items, 3), which));
}
#endif

// In: point (3), choice, u (2), live or not. Out: direction (3), distance, radiance (3), pdf,
// delta, valid.
SCENE_PROBE(light_sample) {
    const LightSample s = light_sample(view, receiver_at(input3(items, 0), zero3()),
                                       input(items, 3), input2(items, 4), input_mask(items, 6));
    output(items, 0, s.direction);
    output(items, 3, s.distance);
    output(items, 4, s.radiance);
    output(items, 7, s.pdf);
    output_mask(items, 8, s.delta);
    output_mask(items, 9, s.valid);
}

// In: direction (3). Out: of the scene's first light, a sun, radiance (3) and pdf.
SCENE_PROBE(sun) {
    const FarLight far = sun_found(view, 0u, input3(items, 0));
    output(items, 0, far.radiance);
    output(items, 3, far.pdf);
}

// In: direction (3), u (2). Out: of the profile of the scene's first light its value in the
// direction; a direction that u samples (3), and the pdf of that.
SCENE_PROBE(profile) {
    const Profile profile = light_profile(view, (natural)(0u));
    output(items, 0, profile_value(view, profile, input3(items, 0)));
    const ProfileSample s = profile_sample(view, profile, input2(items, 3));
    output(items, 1, s.direction);
    output(items, 4, s.pdf);
}

// In: point (3), normal (3), u, a light, live or not. Out: the light that u chooses, its pmf, what
// is left of u; the pmf of the other light.
SCENE_PROBE(light_choice) {
    const Receiver at = receiver_at(input3(items, 0), input3(items, 3));
    const mask live = input_mask(items, 8);
    real2 u = make2(input(items, 6), (real)(0.0f));
    const LightChoice c = light_choice(view, at, u.x, &u, live);
    output(items, 0, c.light);
    output(items, 1, c.pmf);
    output(items, 2, u.x);
    output(items, 3, light_choice_pmf(view, input_natural(items, 7), at, live));
}

// In: origin (3), direction (3), live or not. Out: whether the ray hits, distance, position (3),
// geometric normal (3), shading normal (3), front, light, emitted radiance (3), light_pdf, bulge.
SCENE_PROBE(surface) {
    const real3 origin = input3(items, 0), direction = input3(items, 3);
    const mask live = input_mask(items, 6);
    const Hits hits = trace_closest(view.bvh, origin, direction, mask_bits(live));
    const mask found = live & (hits.primitive != BVH_NONE);
    const Surface s = surface_at(view, origin, direction, hits, found);
    output_mask(items, 0, found);
    output(items, 1, hits.t);
    output(items, 2, s.position);
    output(items, 5, s.geometric);
    output(items, 8, s.normal);
    output_mask(items, 11, s.front);
    output(items, 12, s.light);
    output(items, 13, material_emission(view, s.material, s.uv));
    output(items, 16, light_pdf(view, receiver_at(origin, zero3()), direction, hits.t, s, found));
    output(items, 17, s.bulge);
}

// In: pixel, sample. Out: origin (3), direction (3).
SCENE_PROBE(camera) {
    const natural pixel = input_natural(items, 0);
    const Sampler sampler = sampler_start(pixel, input_natural(items, 1), view.frame->seed);
    const CameraRay ray = camera_ray(view.frame, pixel, sampler);
    output(items, 0, ray.origin);
    output(items, 3, ray.direction);
}

// In: film coordinates (2). Out: origin (3), direction (3).
SCENE_PROBE(ray_through) {
    const CameraRay ray = camera_ray_through(view.frame, input(items, 0), input(items, 1));
    output(items, 0, ray.origin);
    output(items, 3, ray.direction);
}

// In: uniform number. Out: offset.
SCENE_PROBE(filter) {
    output(items, 0, filter_offset(view.frame, input(items, 0)));
}

// In: position (3), u of the lens (2). Out: direction (3), film coordinates (2), importance, valid.
SCENE_PROBE(camera_link) {
    const CameraLink link = camera_link(view.frame, input3(items, 0), input2(items, 3));
    output(items, 0, link.direction);
    output(items, 3, link.x);
    output(items, 4, link.y);
    output(items, 5, link.importance);
    output_mask(items, 6, link.valid);
}

// In: film coordinate, uniform number. Out: chosen pixel along that axis, weight.
SCENE_PROBE(choose_pixel) {
    const FilterChoice choice = choose_pixel(view.frame, input(items, 0), input(items, 1));
    output(items, 0, choice.pixel);
    output(items, 1, choice.weight);
}
