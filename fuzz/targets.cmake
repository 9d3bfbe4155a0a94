# SPDX-License-Identifier: Apache-2.0
# The fuzz targets: fuzz_<name>.cpp with its seeds in corpus/<name>/, and what each is linked with. A target is built with no more
# than it needs: an instrumented build of everything takes long.
set(DISMANTLE_FUZZ_TARGETS
  assembly_bytes commands dasm freecad gltf http journal motion obj path ply reader_messages step steps stl threemf urdf vrml wire)
set(DISMANTLE_FUZZ_LIBRARIES_assembly_bytes dismantle_assembly)
set(DISMANTLE_FUZZ_LIBRARIES_commands dismantle_server)
set(DISMANTLE_FUZZ_LIBRARIES_dasm dismantle_assembly)
set(DISMANTLE_FUZZ_LIBRARIES_freecad dismantle_formats_freecad)
set(DISMANTLE_FUZZ_LIBRARIES_gltf dismantle_formats_gltf)
find_package(Boost 1.74 REQUIRED)
set(DISMANTLE_FUZZ_LIBRARIES_http dismantle_server Boost::headers)
set(DISMANTLE_FUZZ_LIBRARIES_journal dismantle_session)
set(DISMANTLE_FUZZ_LIBRARIES_motion dismantle_documents)
set(DISMANTLE_FUZZ_LIBRARIES_obj dismantle_formats_mesh)
set(DISMANTLE_FUZZ_LIBRARIES_path dismantle_documents)
set(DISMANTLE_FUZZ_LIBRARIES_ply dismantle_formats_mesh)
set(DISMANTLE_FUZZ_LIBRARIES_reader_messages dismantle_loading)
set(DISMANTLE_FUZZ_LIBRARIES_step dismantle_loading)
set(DISMANTLE_FUZZ_LIBRARIES_steps dismantle_audit dismantle_certificates dismantle_session)
set(DISMANTLE_FUZZ_LIBRARIES_stl dismantle_formats_mesh)
set(DISMANTLE_FUZZ_LIBRARIES_threemf dismantle_formats_threemf)
set(DISMANTLE_FUZZ_LIBRARIES_urdf dismantle_formats_urdf)
set(DISMANTLE_FUZZ_LIBRARIES_vrml dismantle_formats_vrml)
set(DISMANTLE_FUZZ_LIBRARIES_wire dismantle_server)

# Links a target with what it needs.
function(dismantle_fuzz_target program name)
  target_include_directories(${program} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${program} PRIVATE dismantle_formats_import ${DISMANTLE_FUZZ_LIBRARIES_${name}})
  if(name STREQUAL "step")  # it starts the reader of CAD files
    add_dependencies(${program} dismantle_read_cad)
  endif()
endfunction()
