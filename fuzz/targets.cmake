# SPDX-License-Identifier: Apache-2.0
# The fuzz targets: fuzz_<name>.cpp with its seeds in corpus/<name>/.
set(DISMANTLE_FUZZ_TARGETS assembly_bytes dasm freecad gltf motion obj path ply stl threemf urdf vrml)
# What they are linked with.
set(DISMANTLE_FUZZ_LIBRARIES
  dismantle_documents dismantle_formats_dasm dismantle_formats_freecad dismantle_formats_threemf dismantle_formats_urdf
  dismantle_formats_vrml dismantle_loading)
