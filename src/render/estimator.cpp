#include "render/estimator.h"

#include "shared/columns.h"

namespace onde {

PathEstimator::PathEstimator()
    : shape_{.file = "path/estimator.h",
             .defines = {},
             .state_columns = COLUMN_COUNT(PATH_COLUMNS),
             .connection_columns = COLUMN_COUNT(CONNECTION_COLUMNS)} {}

} // namespace onde
