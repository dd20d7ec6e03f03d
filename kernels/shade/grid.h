// Media that are as dense as a grid says (see GridRecord in shared/scene.h): rays go through it
// brick by brick (Amanatides and Woo 1987) and collide with what would be there if a brick were as
// dense everywhere as it is at most (Woodcock et al. 1965); what they do there, the density
// decides.
#ifndef ONDE_SHADE_GRID_H
#define ONDE_SHADE_GRID_H

#include "math/random.h"
#include "shade/scene_view.h"

#if ONDE_GRIDS

    // The most collisions and bricks of a ray; behind them no light arrives.
    #define MOST_GRID_STEPS 65536u
    #define GRID_END 1e30f

// How far a ray has come.
typedef struct {
    natural grid;
    real3 origin, direction; // in samples; distances are those of the world
    real at, end;            // where it is, and where it leaves the grid or ends
    real3 brick;             // the one that it is in: whole numbers
    real3 next;              // distances at which it crosses the brick's faces, by axis
    real largest;            // density in the brick
    natural first;           // of the brick's samples
    real passed;             // largest densities, times the lengths of the way
    real left;               // nepers to the next collision
    natural collisions;      // so far
    natural key;             // of its random numbers
    mask open;               // whether it goes on
} GridWay;

INLINE real grid_nepers(real u) {
    return -0.69314718f * log2_real(max_real(1.0f - u, (real)(1e-8f)));
}

// Two numbers a collision: of the density, and of the way to the next; and one a step.
INLINE real grid_random(GridWay way, uint which) {
    return stream_real(way.key, way.collisions * 2u + which);
}

// Where a ray crosses the faces of a brick that it leaves by, along one axis.
INLINE real face_crossing(real brick, real origin, real direction) {
    const real face = choose(direction > 0.0f, brick + 1.0f, brick) * (float)BRICK_CELLS;
    const mask moves = fabs(direction) > 1e-30f;
    return choose(moves, (face - origin) / choose(moves, direction, (real)(1.0f)),
                  (real)(GRID_END));
}

// The rays in `lanes` are in another brick than before.
INLINE void enter_brick(SceneView view, GridWay* way, mask lanes) {
    const real3 next = make3(face_crossing(way->brick.x, way->origin.x, way->direction.x),
                             face_crossing(way->brick.y, way->origin.y, way->direction.y),
                             face_crossing(way->brick.z, way->origin.z, way->direction.z));
    way->next = choose(lanes, next, way->next);
    const natural width = RECORD_NATURAL(view.grids, way->grid, GridRecord, table[0]);
    const natural height = RECORD_NATURAL(view.grids, way->grid, GridRecord, table[1]);
    const natural x = as_natural(to_integer(way->brick.x));
    const natural y = as_natural(to_integer(way->brick.y));
    const natural z = as_natural(to_integer(way->brick.z));
    const natural table = RECORD_NATURAL(view.grids, way->grid, GridRecord, bricks);
    const natural word =
        choose(lanes, table + BRICK_WORDS * (x + width * (y + height * z)), (natural)(0u));
    const real largest = as_real(gather_natural(view.voxels, word)) *
                         RECORD(view.grids, way->grid, GridRecord, scale);
    way->largest = choose(lanes, min_real(largest, (real)(1e15f)), way->largest);
    way->first = choose(lanes, gather_natural(view.voxels, word + 1u), way->first);
}

// The last brick along each axis.
INLINE real3 last_brick(SceneView view, natural grid) {
    return make3(to_real(RECORD_NATURAL(view.grids, grid, GridRecord, table[0]) - 1u),
                 to_real(RECORD_NATURAL(view.grids, grid, GridRecord, table[1]) - 1u),
                 to_real(RECORD_NATURAL(view.grids, grid, GridRecord, table[2]) - 1u));
}

INLINE real brick_of(real sample, real last) {
    const real brick = floor(sample * (1.0f / (float)BRICK_CELLS));
    return min_real(max_real(brick, (real)(0.0f)), last);
}

// Where a ray is between two planes: from x to y.
INLINE real2 way_between(real origin, real direction, real low, real high) {
    const mask moves = fabs(direction) > 1e-30f;
    const real inverse = 1.0f / choose(moves, direction, (real)(1.0f));
    const real a = (low - origin) * inverse, b = (high - origin) * inverse;
    const mask inside = (origin >= low) & (origin <= high);
    const real always = choose(inside, (real)(-GRID_END), (real)(GRID_END));
    return make2(choose(moves, min_real(a, b), always), choose(moves, max_real(a, b), -always));
}

INLINE real to_samples(SceneView view, natural grid, uint row, real3 v) {
    return fma(RECORD(view.grids, grid, GridRecord, to_samples[4 * row]), v.x,
               fma(RECORD(view.grids, grid, GridRecord, to_samples[4 * row + 1]), v.y,
                   RECORD(view.grids, grid, GridRecord, to_samples[4 * row + 2]) * v.z));
}

// The rays in `lanes`, from distance `begin` to `end`. key: of their random numbers. u: of the way
// to the first collision.
INLINE GridWay grid_way(SceneView view, natural grid, real3 origin, real3 direction, real begin,
                        real end, natural key, real u, mask lanes) {
    GridWay way;
    way.grid = choose(lanes, grid, (natural)(0u));
    way.origin = make3(to_samples(view, way.grid, 0, origin), to_samples(view, way.grid, 1, origin),
                       to_samples(view, way.grid, 2, origin));
    way.origin = add3(way.origin, make3(RECORD(view.grids, way.grid, GridRecord, to_samples[3]),
                                        RECORD(view.grids, way.grid, GridRecord, to_samples[7]),
                                        RECORD(view.grids, way.grid, GridRecord, to_samples[11])));
    way.direction =
        make3(to_samples(view, way.grid, 0, direction), to_samples(view, way.grid, 1, direction),
              to_samples(view, way.grid, 2, direction));
    const real3 low = RECORD3(view.grids, way.grid, GridRecord, low);
    const real3 high = RECORD3(view.grids, way.grid, GridRecord, high);
    const real2 x = way_between(way.origin.x, way.direction.x, low.x, high.x);
    const real2 y = way_between(way.origin.y, way.direction.y, low.y, high.y);
    const real2 z = way_between(way.origin.z, way.direction.z, low.z, high.z);
    way.at = max_real(max_real(x.x, y.x), max_real(z.x, begin));
    way.end = min_real(min_real(x.y, y.y), min_real(z.y, end));
    way.open = lanes & (way.at < way.end);
    const real3 from = choose(way.open, madd3(way.direction, way.at, way.origin), zero3());
    const real3 last = last_brick(view, way.grid);
    way.brick = make3(brick_of(from.x, last.x), brick_of(from.y, last.y), brick_of(from.z, last.z));
    way.next = zero3();
    way.largest = way.passed = (real)(0.0f);
    way.first = way.collisions = (natural)(0u);
    way.key = key;
    way.left = grid_nepers(u);
    enter_brick(view, &way, way.open);
    return way;
}

// The rays in `lanes` have come to the end of their brick.
INLINE void cross_face(SceneView view, GridWay* way, mask lanes) {
    const real3 d = way->direction, next = way->next;
    const mask x = lanes & (next.x <= next.y) & (next.x <= next.z);
    const mask y = lanes & !x & (next.y <= next.z);
    const mask z = lanes & !x & !y;
    const real one = (real)(1.0f);
    way->brick.x += choose(x, choose(d.x > 0.0f, one, -one), (real)(0.0f));
    way->brick.y += choose(y, choose(d.y > 0.0f, one, -one), (real)(0.0f));
    way->brick.z += choose(z, choose(d.z > 0.0f, one, -one), (real)(0.0f));
    const real3 last = last_brick(view, way->grid);
    const mask inside = (way->brick.x >= 0.0f) & (way->brick.x <= last.x) & (way->brick.y >= 0.0f) &
                        (way->brick.y <= last.y) & (way->brick.z >= 0.0f) &
                        (way->brick.z <= last.z);
    const mask goes_on = lanes & inside & (way->at < way->end);
    way->open = way->open & (goes_on | !lanes);
    enter_brick(view, way, goes_on);
}

// Takes the rays that go on as far as their next collision, or the end of their brick. rate: of
// collisions, per unit of length at density 1. Returns those that have collided.
INLINE mask grid_step(SceneView view, GridWay* way, real rate) {
    const mask open = way->open;
    const real nearest = min_real(way->next.x, min_real(way->next.y, way->next.z));
    const real far = max_real(min_real(nearest, way->end), way->at);
    const real dense = way->largest * rate, reach = dense * (far - way->at);
    const mask collides = open & (way->left < reach);
    const real to = choose(collides, way->at + way->left / max_real(dense, (real)(1e-30f)), far);
    const real reached = choose(open, min_real(to, far), way->at);
    way->passed += way->largest * (reached - way->at);
    way->at = reached;
    way->left = choose(open & !collides, way->left - reach, way->left);
    const mask leaves = open & !collides;
    if_any (leaves) cross_face(view, way, leaves);
    return collides;
}

// The density at a distance along the way, within its brick.
INLINE real grid_density(SceneView view, GridWay way, real at, mask lanes) {
    const real3 p =
        sub3(madd3(way.direction, at, way.origin), scale3(way.brick, (real)((float)BRICK_CELLS)));
    const float most = (float)BRICK_CELLS - 1.0f;
    const real3 cell = make3(clamp_real(floor(p.x), 0.0f, most), clamp_real(floor(p.y), 0.0f, most),
                             clamp_real(floor(p.z), 0.0f, most));
    const real x = clamp_real(p.x - cell.x, 0.0f, 1.0f), y = clamp_real(p.y - cell.y, 0.0f, 1.0f);
    const real z = clamp_real(p.z - cell.z, 0.0f, 1.0f);
    const mask varies = lanes & (way.first != NO_INDEX);
    const natural place = as_natural(to_integer(cell.x)) +
                          BRICK_ROW * as_natural(to_integer(cell.y)) +
                          BRICK_LAYER * as_natural(to_integer(cell.z));
    const natural word = choose(varies, way.first + place, (natural)(0u));
    real along[4];
    for (uint k = 0; k < 4; k++) {
        const natural corner =
            choose(varies, word + (k & 1u) * BRICK_ROW + (k >> 1u) * BRICK_LAYER, (natural)(0u));
        const natural pair = gather_natural(view.voxels, corner);
        const real before = to_real(pair & 0xffffu), behind = to_real(pair >> 16u);
        along[k] = fma(behind - before, x, before);
    }
    const real low = fma(along[1] - along[0], y, along[0]);
    const real high = fma(along[3] - along[2], y, along[2]);
    const real share = fma(high - low, z, low) * (1.0f / 65535.0f);
    return choose(varies, way.largest * share, way.largest);
}

// The share of what they collide with that is there, of rays in `lanes`.
INLINE real collision_share(SceneView view, GridWay way, mask lanes) {
    const real density = grid_density(view, way, way.at, lanes);
    return min_real(density / max_real(way.largest, (real)(1e-30f)), (real)(1.0f));
}

// The rays in `lanes` are behind their collision.
INLINE void pass_collision(GridWay* way, mask lanes) {
    way->left = choose(lanes, grid_nepers(grid_random(*way, 1u)), way->left);
    way->collisions += one_for(lanes);
}

// How much comes through from distance `begin` to `end` (ratio tracking: Novak et al. 2014,
// Residual Ratio Tracking for Estimating Attenuation in Participating Media); 1 in other lanes.
INLINE real3 grid_transmittance(SceneView view, natural grid, real3 extinction, real3 origin,
                                real3 direction, real begin, real end, natural key, mask lanes) {
    const real rate = max_component3(extinction);
    const real3 share = scale3(extinction, 1.0f / max_real(rate, (real)(1e-30f)));
    real3 left = splat3((real)(1.0f));
    GridWay way = grid_way(view, grid, origin, direction, begin, end, hash_natural(key),
                           stream_real(key, (natural)(0u)), lanes & (rate > 0.0f));
    for (uint step = 0; step < MOST_GRID_STEPS && mask_bits(way.open); step++) {
        const mask collides = grid_step(view, &way, rate);
        if (!mask_bits(collides)) continue;
        const real there = collision_share(view, way, collides);
        real3 less = mul3(left, sub3(splat3((real)(1.0f)), scale3(share, there)));
        // What is nearly nothing is nothing, or twice as much.
        const mask small = max_component3(less) < 0.1f;
        const mask dies = collides & small & (grid_random(way, 0u) < 0.5f);
        less = choose(small, scale3(less, (real)(2.0f)), less);
        left = choose(collides, choose(dies, zero3(), less), left);
        way.open = way.open & !dies & (nonzero3(left) | !collides);
        pass_collision(&way, collides);
    }
    return choose(way.open, zero3(), left);
}
#endif

#endif
