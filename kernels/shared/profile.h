// How photometric lights shine by direction, as words of one buffer. A profile has a grid of cells
// over the sphere: rows of equal steps of the angle to its axis, and in them columns of equal steps
// of the angle around it. It begins with the numbers of rows and columns; then follow its values at
// the nodes, which are one row more, and for each cell an entry of an alias table with its
// probability.
#ifndef ONDE_SHARED_PROFILE_H
#define ONDE_SHARED_PROFILE_H

#define PROFILE_ROWS 0u
#define PROFILE_COLUMNS 1u
#define PROFILE_NODES 2u

#define PROFILE_CELL_WORDS 3u // of an entry:
#define PROFILE_BELOW 0u      // stay when the fraction of the draw is below, else take the alias
#define PROFILE_ALIAS 1u
#define PROFILE_PMF 2u

#endif
