# Filled in by src/gpu.
