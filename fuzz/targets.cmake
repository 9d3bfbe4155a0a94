# SPDX-License-Identifier: Apache-2.0
# The fuzz targets: fuzz_<name>.cpp with its seeds in corpus/<name>/.
set(DISMANTLE_FUZZ_TARGETS
  assembly_bytes commands dasm freecad gltf journal motion obj path ply reader_messages steps stl threemf urdf vrml wire)
# What they are linked with.
set(DISMANTLE_FUZZ_LIBRARIES
  dismantle_audit dismantle_certificates dismantle_documents dismantle_formats_dasm dismantle_formats_freecad dismantle_formats_threemf dismantle_formats_urdf
  dismantle_formats_vrml dismantle_loading dismantle_server dismantle_session)
