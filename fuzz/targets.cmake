# SPDX-License-Identifier: Apache-2.0
# The fuzz targets: fuzz_<name>.cpp with its seeds in corpus/<name>/.
set(DISMANTLE_FUZZ_TARGETS assembly_bytes dasm freecad gltf motion obj path ply stl threemf urdf vrml)
