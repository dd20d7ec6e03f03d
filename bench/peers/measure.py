"""Runs a command from a small process of its own, so that its peak memory is not that of who asks:
measure.py RESULT COMMAND...; writes {"code", "seconds", "peak_mib"} to RESULT.
"""

import json
import os
import sys
import time

start = time.monotonic()
child = os.posix_spawnp(sys.argv[2], sys.argv[2:], os.environ)
_, status, usage = os.wait4(child, 0)
seconds = time.monotonic() - start
with open(sys.argv[1], "w") as result:
    json.dump({"code": os.waitstatus_to_exitcode(status), "seconds": seconds, "peak_mib": usage.ru_maxrss / 1024}, result)
