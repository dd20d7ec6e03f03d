#include "render/estimator.h"

#include "shared/aovs.h"
#include "shared/columns.h"

namespace onde {

PathEstimator::PathEstimator(const RenderOptions& options, const SceneFeatures& scene)
    : shape_{.file = "path/estimator.h",
             .defines = {},
             .state_columns = COLUMN_COUNT(PATH_COLUMNS),
             .connection_columns = COLUMN_COUNT(CONNECTION_COLUMNS)} {
    if (options.aovs >> AOV_UV & 1) shape_.defines.emplace_back("ONDE_UV=1");
    if (scene.shutter) shape_.state_columns += COLUMN_COUNT(TIME_COLUMNS);
    if (scene.light_tree) shape_.state_columns += COLUMN_COUNT(RECEIVER_COLUMNS);
    if (!options.light_groups.empty()) shape_.connection_columns += COLUMN_COUNT(TARGET_COLUMNS);
    if (scene.dispersion) shape_.state_columns += COLUMN_COUNT(WAVE_COLUMNS);
    if (scene.panes) shape_.state_columns += COLUMN_COUNT(PANE_COLUMNS);
    if (scene.media) shape_.state_columns += COLUMN_COUNT(MEDIA_COLUMNS);
    if (scene.unbent || scene.media) shape_.connection_columns += COLUMN_COUNT(WAY_COLUMNS);
    if ((options.aovs & (GUIDE_AOVS | LIGHT_AOVS)) == 0) return;
    shape_.defines.emplace_back("ONDE_TRAIL=1");
    shape_.state_columns += COLUMN_COUNT(TRAIL_COLUMNS);
    shape_.connection_columns += COLUMN_COUNT(SHARE_COLUMNS);
}

} // namespace onde
