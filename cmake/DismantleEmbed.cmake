# SPDX-License-Identifier: Apache-2.0
# dismantle_embed_files(TARGET FILES PATH FILE PATH FILE ...): makes the static library TARGET with web_files() (web/web_files.h),
# which gives each FILE under its PATH. A FILE may be made by a custom command of the same CMakeLists.txt. What kind of file
# it is shows in the PATH's extension.
function(dismantle_embed_files target)
  cmake_parse_arguments(arg "" "" "FILES" ${ARGN})
  set(types
    .html "text/html, utf-8" .js "text/javascript, utf-8" .css "text/css, utf-8" .txt "text/plain, utf-8"
    .json "application/json" .map "application/json" .svg "image/svg+xml" .png "image/png" .ico "image/x-icon"
    .woff2 "font/woff2")
  set(assembly "")
  set(entries "")
  set(files "")
  set(index 0)
  while(arg_FILES)
    list(POP_FRONT arg_FILES path file)
    cmake_path(GET path EXTENSION LAST_ONLY extension)
    list(FIND types "${extension}" place)
    if(place LESS 0)
      message(FATAL_ERROR "dismantle_embed_files: no content type is known for ${path}")
    endif()
    math(EXPR place "${place} + 1")
    list(GET types ${place} type)
    string(REPLACE ", utf-8" "; charset=utf-8" type "${type}")  # a semicolon would part the list
    set(name "dismantle_web_file_${index}")
    string(APPEND assembly "DISMANTLE_EMBED(${name}, \"${file}\");\n")
    string(APPEND entries "    {\"${path}\", \"${type}\", text(${name}, ${name}_end)},\n")
    list(APPEND files "${file}")
    math(EXPR index "${index} + 1")
  endwhile()

  set(source "${CMAKE_CURRENT_BINARY_DIR}/${target}_files.cpp")
  file(CONFIGURE OUTPUT "${source}" @ONLY CONTENT [[// Made by dismantle_embed_files: the assembler takes the files in whole.
#include "web/web_files.h"

#define DISMANTLE_EMBED(symbol, file)                                                                                 \
  __asm__(".section .rodata\n.balign 8\n" #symbol ":\n.incbin \"" file "\"\n" #symbol "_end:\n.byte 0\n.previous\n"); \
  extern "C" __attribute__((visibility("hidden"))) const char symbol[], symbol##_end[]

@assembly@
namespace dismantle {

namespace {

std::string_view text(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

const WebFile kFiles[] = {
@entries@};

}  // namespace

Span<const WebFile> web_files() {
  return {kFiles, sizeof kFiles / sizeof kFiles[0]};
}

}  // namespace dismantle
]])
  add_library(${target} STATIC "${source}")
  # Link-time optimisation would separate the symbols from the code that uses them.
  set_source_files_properties("${source}" PROPERTIES OBJECT_DEPENDS "${files}" COMPILE_OPTIONS -fno-lto)
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(${target} PUBLIC dismantle_core)
endfunction()
