# SPDX-License-Identifier: Apache-2.0
# Settings every target shares, and the functions that declare a library component and a test.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

# Floating-point results must not depend on the compiler's mood: no contraction, never fast-math. Where GCC 12 vectorises straight code,
# doubles that are rounded to floats and back keep their digits, so that a box is not the one that was stored
# (tests/math/float_rounding_test.cpp).
add_library(dismantle_build_settings INTERFACE)
target_compile_features(dismantle_build_settings INTERFACE cxx_std_20)
# Warnings are ours to mend, not for those who use an installed dismantle. -Wrestrict of GCC 12 is wrong about strings at -O3
# (https://gcc.gnu.org/bugzilla/show_bug.cgi?id=105329).
target_compile_options(dismantle_build_settings INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off>
  $<$<COMPILE_LANGUAGE:CUDA>:--fmad=false$<SEMICOLON>-Xcompiler=-ffp-contract=off>
  $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fno-tree-slp-vectorize>
  $<$<COMPILE_LANG_AND_ID:CUDA,NVIDIA>:-Xcompiler=-fno-tree-slp-vectorize>
  $<BUILD_INTERFACE:$<$<COMPILE_LANGUAGE:CXX>:-Wall$<SEMICOLON>-Wextra$<SEMICOLON>-Wshadow$<SEMICOLON>-Wno-unknown-pragmas>>
  $<BUILD_INTERFACE:$<$<AND:$<COMPILE_LANG_AND_ID:CXX,GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>,$<CONFIG:Release>>:-Wno-restrict>>)
target_compile_definitions(dismantle_build_settings INTERFACE
  $<$<BOOL:${DISMANTLE_CONTRACTS}>:DISMANTLE_CONTRACTS=1>)
if(DISMANTLE_WERROR)
  target_compile_options(dismantle_build_settings INTERFACE
    $<BUILD_INTERFACE:$<$<COMPILE_LANGUAGE:CXX>:-Werror>$<$<COMPILE_LANGUAGE:CUDA>:-Werror=all-warnings>>)
endif()
if(DISMANTLE_SANITIZE)
  add_compile_options(-fsanitize=${DISMANTLE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${DISMANTLE_SANITIZE})
endif()
# The 160 programs of a checked build are linked in half the time by gold.
if(DISMANTLE_CONTRACTS AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  find_program(DISMANTLE_GOLD ld.gold)
  if(DISMANTLE_GOLD)
    add_link_options(-fuse-ld=gold)
  endif()
endif()
install(TARGETS dismantle_build_settings EXPORT dismantleTargets)

# dismantle_precompile_headers(TARGET): a library takes the usual standard headers from one precompiled file, which saves a third of
# the time of compiling it. Only with DISMANTLE_PRECOMPILED_HEADERS: a missing #include does not show then (tools/check_tidy and
# tools/check_layers compile without). The compiler refuses the file in a target with other options, such as -pthread:
# DISABLE_PRECOMPILE_HEADERS there. GCC 12 at times warns of standard code that it inlined from the file, and only then:
# SKIP_PRECOMPILE_HEADERS for such a source.
function(dismantle_precompile_headers target)
  if(NOT DISMANTLE_PRECOMPILED_HEADERS)
    return()
  endif()
  if(NOT TARGET library_headers_precompiled)
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/library_headers_precompiled.cpp CONTENT "")
    add_library(library_headers_precompiled OBJECT ${PROJECT_BINARY_DIR}/library_headers_precompiled.cpp)
    target_link_libraries(library_headers_precompiled PRIVATE dismantle_build_settings)
    target_precompile_headers(library_headers_precompiled PRIVATE <algorithm> <array> <cmath> <cstdint> <filesystem> <functional>
      <limits> <map> <memory> <numeric> <optional> <set> <span> <sstream> <string> <string_view> <unordered_map> <unordered_set>
      <utility> <variant> <vector>)
  endif()
  target_precompile_headers(${target} REUSE_FROM library_headers_precompiled)
endfunction()

# dismantle_component(NAME
#   SOURCES a.cpp ...           absent for a header-only component
#   PRIVATE_HEADERS a.h ...     headers that are not installed: those that show a private library
#   DEPENDS core math ...       other components: the only ones this one may include (tools/check_layers)
#   LIBRARIES ...               third-party targets that users of this component also need
#   PRIVATE_LIBRARIES ...)      third-party targets that only this component's .cpp files and private headers see
# All other headers below the folder are installed: they are the target's header set.
function(dismantle_component name)
  cmake_parse_arguments(arg "" "" "SOURCES;PRIVATE_HEADERS;DEPENDS;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  set(target dismantle_${name})
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}" "*.h")
  list(REMOVE_ITEM headers ${arg_PRIVATE_HEADERS})
  if(arg_SOURCES)
    add_library(${target} STATIC ${arg_SOURCES})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE ${arg_PRIVATE_LIBRARIES})
    dismantle_precompile_headers(${target})
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(dismantle::${name} ALIAS ${target})
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:include>)
  target_link_libraries(${target} ${scope} dismantle_build_settings)
  foreach(dep IN LISTS arg_DEPENDS)
    target_link_libraries(${target} ${scope} dismantle_${dep})
  endforeach()
  target_link_libraries(${target} ${scope} ${arg_LIBRARIES})
  target_sources(${target} ${scope} FILE_SET HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}/src" FILES ${headers})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS ${target} EXPORT dismantleTargets ARCHIVE DESTINATION lib FILE_SET HEADERS DESTINATION include)
  set_property(GLOBAL APPEND PROPERTY DISMANTLE_COMPONENTS ${name})
endfunction()

# dismantle_lane_kernel(TARGET SOURCE): compiles SOURCE, the kernel of some entry, once a lane count and adds it to TARGET;
# how such a source is written: src/dismantle/math/lanes.h. Each compilation has DISMANTLE_LANE_COUNT=1, 4, 8 or 16 and
# the flags that this width needs and no more: none allows fused operations that contraction could use.
function(dismantle_lane_kernel target source)
  set(counts 1 4)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
    list(APPEND counts 8 16)
  endif()
  set(flags_8 -mavx2)
  set(flags_16 -mavx512f -mavx512bw -mavx512dq -mavx512vl)
  cmake_path(GET source STEM stem)
  foreach(count IN LISTS counts)
    set(object ${target}_${stem}_${count})
    add_library(${object} OBJECT ${source})
    target_include_directories(${object} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
    target_link_libraries(${object} PRIVATE dismantle_build_settings)
    target_compile_definitions(${object} PRIVATE DISMANTLE_LANE_COUNT=${count})
    target_compile_options(${object} PRIVATE ${flags_${count}})
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${object}>)
    set_property(GLOBAL APPEND PROPERTY DISMANTLE_LANE_OBJECTS ${object})
  endforeach()
endfunction()

# dismantle_checked_program(TARGET): a program of a checked build, a test or a benchmark. Nearly all that a compiler does for it is to read
# headers: the usual ones are precompiled, one set for all programs, and it is optimised less than what it tests.
function(dismantle_checked_program target)
  if(NOT TARGET test_headers_precompiled)
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/test_headers_precompiled.cpp CONTENT "")
    add_library(test_headers_precompiled OBJECT ${PROJECT_BINARY_DIR}/test_headers_precompiled.cpp)
    target_link_libraries(test_headers_precompiled PRIVATE dismantle_build_settings GTest::gtest)
    target_compile_options(test_headers_precompiled PRIVATE $<$<CONFIG:RelWithDebInfo>:-O1$<SEMICOLON>-g0> -fPIE)
    set_target_properties(test_headers_precompiled PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    target_precompile_headers(test_headers_precompiled PRIVATE <gtest/gtest.h> <algorithm> <array> <chrono> <cmath> <filesystem>
      <fstream> <functional> <map> <memory> <numbers> <optional> <random> <set> <string> <thread> <vector>)
  endif()
  target_compile_options(${target} PRIVATE $<$<CONFIG:RelWithDebInfo>:-O1$<SEMICOLON>-g0>)
  # The compiler refuses the file in a target without the definitions that it was made with.
  target_compile_options(${target} PRIVATE $<TARGET_PROPERTY:GTest::gtest,INTERFACE_COMPILE_OPTIONS>)
  target_precompile_headers(${target} REUSE_FROM test_headers_precompiled)
endfunction()

# dismantle_test(NAME SOURCES ... DEPENDS component ... [LIBRARIES ...]): one test program for one folder of tests.
function(dismantle_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS;LIBRARIES" ${ARGN})
  set(target test_${name})
  add_executable(${target} ${arg_SOURCES})
  foreach(dep IN LISTS arg_DEPENDS)
    target_link_libraries(${target} PRIVATE dismantle_${dep})
  endforeach()
  target_link_libraries(${target} PRIVATE ${arg_LIBRARIES} GTest::gtest GTest::gtest_main)
  if(TARGET dismantle_readers AND arg_DEPENDS MATCHES "(^|;)(loading|batch)(;|$)")
    add_dependencies(${target} dismantle_readers)
  endif()
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR})
  dismantle_checked_program(${target})
  target_compile_definitions(${target} PRIVATE
    DISMANTLE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" DISMANTLE_BINARY_DIR="${PROJECT_BINARY_DIR}")
  gtest_discover_tests(${target} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endfunction()
