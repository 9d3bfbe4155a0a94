// SPDX-License-Identifier: Apache-2.0
#include "dismantle/loading/run_reader.h"

#include "dismantle/isolation/isolated_child.h"
#include "dismantle/loading/reader_messages.h"

#include <new>
#include <stdexcept>

namespace dismantle {

namespace {

Result<Done> serve(const ModelReader& read, std::string_view bytes, IsolatedLine& line) {
  std::optional<ReaderRequest> request = reader_request_from(bytes);
  if (!request || request->version != DISMANTLE_VERSION)
    return Error{ErrorKind::Failed,
                 "the model cannot be read (dismantle and its reader program are of different versions); install "
                 "dismantle again"};
  request->options.progress = [&line](std::string_view stage, double fraction) {
    line.report(stage, fraction);
    return true;
  };
  try {
    const Result<ImportedAssembly> imported = read(request->file, request->options);
    if (!imported) return imported.error();
    write_answer(*imported, [&line](const void* data, std::size_t size) { line.write(data, size); });
    return Done{};
  } catch (const std::length_error&) {
    throw std::bad_alloc();
  }
}

}  // namespace

int run_reader(const ModelReader& read) {
  return run_isolated_child([&](std::string_view request, IsolatedLine& line) { return serve(read, request, line); });
}

}  // namespace dismantle
