// Tables of directional albedos: how much of white light from one direction a rough boundary's
// microfacets, GGX's where nothing else is said, scatter at once, the rest of it being lost among
// them. A table has a row by roughness, and in it a word by the cosine of the direction; behind the
// rows follows a word by roughness, of means over the hemisphere, weighted by the cosine. Words are
// two numbers of 16 bits, the first one in the lower half.
#ifndef ONDE_SHARED_ALBEDO_H
#define ONDE_SHARED_ALBEDO_H

#define ALBEDO_ROWS 32u
#define ALBEDO_COLUMNS 32u
#define ALBEDO_MEANS (ALBEDO_ROWS * ALBEDO_COLUMNS)
#define ALBEDO_TABLE (ALBEDO_MEANS + ALBEDO_ROWS) // words
#define SHEEN_TABLE ALBEDO_TABLE                  // its first word; that of reflection is at 0

// Sheen changes most towards grazing angles, however smooth: the alpha of its rows' places.
#define SHEEN_PLACE_ALPHA 0.15f

// Reflection by microfacets with a grain, along which they are rougher. The table has a block by
// roughness across the grain, in it one by strength, in it a row by azimuth, and in it a word by
// the cosine, whose place is that of the alpha that the azimuth sees.
#define GRAIN_ROWS 12u
#define GRAIN_COLUMNS 8u
#define GRAIN_TABLE (2u * ALBEDO_TABLE) // its first word
#define GRAIN_WORDS (GRAIN_ROWS * GRAIN_ROWS * GRAIN_COLUMNS * GRAIN_COLUMNS)
#define BECKMANN_TABLE (GRAIN_TABLE + GRAIN_WORDS) // of reflection, by Beckmann's microfacets
#define BECKMANN_GRAIN_TABLE (BECKMANN_TABLE + ALBEDO_TABLE)
#define GLASS_TABLES (BECKMANN_GRAIN_TABLE + GRAIN_WORDS)

// Albedos of small alpha change where cosines are as small: where a direction lies in its row,
// from 0 to 1.
#define ALBEDO_PLACE(cosine, alpha) ((cosine) * (1.0f + (alpha)) / ((cosine) + (alpha)))

// What the numbers of a table are.
// Reflection, the first table: the albedo of a white surface; and of it the share of Schlick's
// weight, less that weight of the direction itself, from -1 to 1. The means are of the first, and
// of what Schlick's weight counts. Sheen, the second table: of white fibres; nothing. Reflection
// with a grain, the third: as the first. Beckmann's, the fourth and fifth, without grain and with
// one: as the first. Glass, of either distribution: from outside; from inside.

#endif
