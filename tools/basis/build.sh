#!/bin/bash
# Builds libonde_basis.so, by which Onde reads KTX2 textures of Basis Universal, beside the program:
# tools/basis/build.sh [FOLDER (build/onde)]. The transcoder's sources come with PyPI's opengl-basisu
# (Apache-2.0). Takes half a minute; needs g++, pip and libzstd-dev.
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
folder=$(readlink -f "${1:-$here/../../build/onde}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m pip download --quiet --no-binary opengl-basisu --no-deps \
    --dest "$work" opengl-basisu==0.1.0a2
tar -xzf "$work"/opengl*basisu-0.1.0a2.tar.gz -C "$work"
source=$(dirname "$(find "$work" -name basisu_transcoder.cpp -print -quit)")
g++ -O2 -fPIC -shared -fvisibility=hidden -fno-strict-aliasing -w \
    -DBASISD_SUPPORT_KTX2=1 -DBASISD_SUPPORT_KTX2_ZSTD=1 -I"$source" -I"$source/../zstd" \
    "$here/transcoder.cpp" "$source/basisu_transcoder.cpp" -lzstd -o "$folder/libonde_basis.so"
echo "wrote $folder/libonde_basis.so"
