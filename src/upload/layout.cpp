// The host's half of the layout contract: sizes and offsets that the probe kernel of the tests
// compares with the device's.
#include "shared/bvh.h"
#include "shared/frame.h"
#include "shared/scene.h"

#include <cstddef>

static_assert(sizeof(BvhNode) == 512 && offsetof(BvhNode, child) == 384);
static_assert(sizeof(TriangleBlock) == 320 && offsetof(TriangleBlock, primitive) == 288);
static_assert(sizeof(BvhCompressed) == 80 && offsetof(BvhCompressed, low_x) == 32);
static_assert(sizeof(BvhPair) == 64 && sizeof(BvhSlot) == 48);
static_assert(sizeof(BvhSphere) == 32 && sizeof(BvhInstance) == 128);
static_assert(sizeof(SurfaceRecord) == 36 && sizeof(VertexRecord) == 12);
static_assert(sizeof(LightRecord) % 4 == 0 && sizeof(TextureRecord) == 64 &&
              sizeof(AliasRecord) == 8 && sizeof(LightBranch) == 32);
static_assert(sizeof(FrameRecord) % 16 == 0 && offsetof(FrameRecord, filter_table) % 16 == 0);
