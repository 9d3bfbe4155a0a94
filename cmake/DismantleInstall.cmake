# SPDX-License-Identifier: Apache-2.0
# install() and find_package(dismantle): the component libraries with their headers (dismantle_component), and one aggregate target
# dismantle::dismantle.
include(CMakePackageConfigHelpers)

get_property(components GLOBAL PROPERTY DISMANTLE_COMPONENTS)
add_library(dismantle INTERFACE)
add_library(dismantle::dismantle ALIAS dismantle)
foreach(component IN LISTS components)
  target_link_libraries(dismantle INTERFACE dismantle_${component})
endforeach()
install(TARGETS dismantle EXPORT dismantleTargets)
install(EXPORT dismantleTargets NAMESPACE dismantle:: DESTINATION lib/cmake/dismantle)
configure_package_config_file(cmake/dismantleConfig.cmake.in "${PROJECT_BINARY_DIR}/dismantleConfig.cmake"
  INSTALL_DESTINATION lib/cmake/dismantle)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/dismantleConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/dismantleConfig.cmake" "${PROJECT_BINARY_DIR}/dismantleConfigVersion.cmake"
  DESTINATION lib/cmake/dismantle)
