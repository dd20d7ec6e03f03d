// One wrong line each: what doctor must find in a folder of kernels, and by which check.
#pragma once

namespace onde::test {

struct Fault {
    const char* what;
    const char* file; ///< of kernels/
    const char* right;
    const char* wrong;  ///< in its place
    const char* check;  ///< the first that fails
    bool often = false; ///< planted in every run of the tests, as its check is quick
};

inline constexpr Fault FAULTS[] = {
    {"a record's fields in another order", "shared/scene.h",
     "    uint normal; // in object space\n    float uv[2];",
     "    float uv[2];\n    uint normal; // in object space", "layout", true},
    {"the sign of a sine", "math/elementary.h", "choose((k & 2) != 0, -sine, sine)",
     "choose((k & 2) != 0, sine, -sine)", "math", true},
    {"an angle's quadrant", "math/elementary.h", "choose(ay > ax, 0.25f - turns, turns)",
     "choose(ay > ax, 0.25f + turns, turns)", "math"},
    {"Schlick's power", "shade/fresnel.h", "return m2 * m2 * m;", "return m2 * m2;", "math"},
    {"a sign in Fresnel's equations", "shade/fresnel.h", "(cosine - eta * refracted) /",
     "(cosine + eta * refracted) /", "math"},
    {"the density of a cone", "math/sampling.h", "return 0.5f * INV_PI / opening;",
     "return INV_PI / opening;", "math"},
    {"the power heuristic's power", "math/sampling.h", "1.0f / fma(ratio, ratio, (real)(1.0f))",
     "1.0f / (ratio + 1.0f)", "math"},
    {"a hash constant", "math/random.h", "v * 747796405u", "v * 747796407u", "random", true},
    {"a mask of Sobol's matrix", "math/random.h", "v ^= (v >> 2) & 0x33333333u;",
     "v ^= (v >> 2) & 0x33333337u;", "random"},
    {"two lanes", "math/lanes.h", "(uint16)(0, 1, 2, 3, 4,", "(uint16)(0, 1, 3, 2, 4,", "lanes"},
    {"a lane's bit", "math/lanes.h", "((natural)(bits) >> lane_index()) & 1u",
     "((natural)(bits) >> (lane_index() ^ 1u)) & 1u", "lanes"},
    {"the planes of a box along y", "trace/bvh_slab.h", "ray.inverse.y < 0.0f ? 192 : 128",
     "ray.inverse.y < 0.0f ? 128 : 192", "traversal"},
    {"the sign of a ray's start", "trace/bvh_slab.h", "const float3 start = -origin * ray.inverse;",
     "const float3 start = origin * ray.inverse;", "traversal"},
    {"a triangle's edge", "trace/triangle.h", "dot##N(across, e1), sign);",
     "dot##N(across, e2), sign);", "traversal", true},
    {"a box of the binary layout", "trace/bvh_binary.h", "min_fast(far_x, far_y)",
     "min_fast(far_x, far_x)", "traversal"},
    {"how textures repeat", "shade/texture.h",
     "choose(i < 0, choose(repeat, last, (integer)(0)), i)", "choose(i < 0, (integer)(0), i)",
     "textures", true},
    {"how textures mirror", "shade/texture.h", "choose(folded > 1.0f, 2.0f - folded, folded)",
     "choose(folded > 1.0f, folded - 1.0f, folded)", "textures"},
    {"the cosine of a diffuse lobe", "shade/lobes/diffuse.h",
     "choose(above, wi.z, (real)(0.0f)) * INV_PI",
     "choose(above, wi.z * wi.z, (real)(0.0f)) * INV_PI", "lobes"},
    {"the density of a glossy lobe", "shade/lobes/glossy.h", "visible / (4.0f * wo.z)",
     "visible / (2.0f * wo.z)", "lobes", true},
    {"Smith's lambda", "shade/microfacet.h", "fma(alpha * alpha, tangent2, (real)(1.0f))",
     "fma(alpha, tangent2, (real)(1.0f))", "lobes"},
    {"the sign of a refracted ray", "shade/lobes/dielectric.h", "fma(cosine, inverse, -refracted)",
     "fma(cosine, inverse, refracted)", "lobes"},
    {"how much rough glass reflects", "shade/lobes/dielectric.h", "b.fresnel * body * 0.25f",
     "b.fresnel * body * 0.5f", "lobes"},
    {"the alias table", "shade/light.h", "const mask stays = rest < below;",
     "const mask stays = rest > below;", "lights"},
    {"the cosine of a flat light's density", "shade/lights/light_type.h",
     "return t * t / (max_real(fabs(cosine)", "return t * t / (max_real(cosine * cosine", "lights"},
    {"the area of a sphere light", "shade/lights/sphere.h", "sine2 / (1.0f + cosine)",
     "sine2 / (1.0f - cosine)", "lights"},
    {"where the environment's centre lies", "shade/environment.h", "-d.z) + (0.5f + view",
     "-d.z) + (0.25f + view", "lights"},
    {"the environment's jacobian", "shade/environment.h", "return 0.5f * INV_PI * INV_PI",
     "return INV_PI * INV_PI", "lights"},
    {"a sample of the film", "film/film.h", "(float4)(radiance.x, radiance.y, radiance.z, 1.0f)",
     "(float4)(radiance.x, radiance.x, radiance.z, 1.0f)", "film"},
    {"a sum of the film's blocks", "film/carry.cl", "block[i] = pending[i] + block[i];",
     "block[i] = pending[i];", "film"},
    {"the weight of roulette's survivors", "path/state.h",
     "scale3(path->throughput, 1.0f / survival)", "scale3(path->throughput, 1.0f)", "furnace"},
    {"the weight of sampled light", "path/path.h", "power_heuristic(light.pdf, f.pdf)",
     "power_heuristic(f.pdf, light.pdf)", "furnace"},
    {"where shadow rays end", "shade/origins.h", "(1.0f - 1e-4f)", "(1.0f + 1e-2f)", "furnace"},
    {"the offset of rays from their surface", "shade/origins.h", "#define ROUNDINGS 32.0f",
     "#define ROUNDINGS -32.0f", "furnace"},
    {"a sum of the megakernel", "megakernel/megakernel.cl",
     "choose(lit, add3(gathered->sum, c.value), gathered->sum)",
     "choose(lit, c.value, gathered->sum)", "engines"},
    {"a lens", "shade/camera.h", "uniform3(frame->lens_v), lens.y *",
     "uniform3(frame->lens_v), lens.x *", "picture"},
    {"the sign of a normal map", "shade/normal_map.h", "scale3(cross3(n, t), frame.sign)",
     "scale3(cross3(t, n), frame.sign)", "picture"},
};

} // namespace onde::test
