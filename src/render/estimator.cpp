#include "render/estimator.h"

#include "shared/aovs.h"
#include "shared/columns.h"

namespace onde {

PathEstimator::PathEstimator(const SceneFeatures& features, const RenderOptions& options)
    : shape_{.file = "path/estimator.h",
             .defines = {},
             .state_columns = COLUMN_COUNT(PATH_COLUMNS),
             .connection_columns = COLUMN_COUNT(CONNECTION_COLUMNS)} {
    if (options.aovs >> AOV_UV & 1) shape_.defines.emplace_back("ONDE_UV=1");
    if (!options.light_groups.empty()) shape_.connection_columns += COLUMN_COUNT(TARGET_COLUMNS);
    if (features.panes) shape_.state_columns += COLUMN_COUNT(PANE_COLUMNS);
    if (features.unbent) shape_.connection_columns += COLUMN_COUNT(UNBENT_COLUMNS);
    if ((options.aovs & (GUIDE_AOVS | LIGHT_AOVS)) == 0) return;
    shape_.defines.emplace_back("ONDE_TRAIL=1");
    shape_.state_columns += COLUMN_COUNT(TRAIL_COLUMNS);
    shape_.connection_columns += COLUMN_COUNT(SHARE_COLUMNS);
}

} // namespace onde
