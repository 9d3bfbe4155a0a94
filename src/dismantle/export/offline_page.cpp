// SPDX-License-Identifier: Apache-2.0
#include "dismantle/export/offline_page.h"

#include "dismantle/documents/path_file.h"
#include "dismantle/export/viewer_model.h"
#include "dismantle/formats/gltf/write_glb.h"
#include "dismantle/report/html_text.h"

#include <zlib.h>

#include <algorithm>
#include <new>

namespace dismantle {

namespace {

/// Maximum size of the unpacked model: browsers fail to load pages of larger ones [bytes].
constexpr std::size_t kMaxModelSize = std::size_t{350} << 20;

constexpr std::string_view kPolicy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; "
    "form-action 'none'";

/// Compresses block by block, so that packing can be cancelled.
class Deflater {
 public:
  Deflater() {
    if (deflateInit(&stream_, Z_DEFAULT_COMPRESSION) != Z_OK) throw std::bad_alloc();
  }
  ~Deflater() { deflateEnd(&stream_); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  void add(std::string_view bytes, bool is_last) {
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // zlib only reads it
    stream_.avail_in = static_cast<uInt>(bytes.size());
    std::uint8_t block[1 << 16];
    do {
      stream_.next_out = block;
      stream_.avail_out = sizeof block;
      deflate(&stream_, is_last ? Z_FINISH : Z_NO_FLUSH);
      packed_.insert(packed_.end(), block, block + (sizeof block - stream_.avail_out));
    } while (stream_.avail_out == 0);
  }
  const std::vector<std::uint8_t>& packed() const { return packed_; }

 private:
  z_stream stream_{};
  std::vector<std::uint8_t> packed_;
};

Result<std::string> packed_model(const Assembly& assembly, const ProgressCallback& progress) {
  const Result<std::string> glb = glb_from_assembly(assembly);
  if (!glb) return glb.error();
  if (glb->size() > kMaxModelSize)
    return Error{ErrorKind::Failed, "the assembly is too large for a page (more than 350 MiB); simplify it"};
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  Deflater deflater;
  for (std::size_t begin = 0; begin < glb->size(); begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, glb->size());
    deflater.add(std::string_view(*glb).substr(begin, end - begin), end == glb->size());
    if (!report_progress(progress, "packing the model", static_cast<double>(end) / static_cast<double>(glb->size())))
      return Error{ErrorKind::Failed, "the page was not written (cancelled); run it again"};
  }
  return base64(deflater.packed());
}

/// JSON escaped so that it cannot end its script element.
std::string safe_json(std::string json) {
  for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at))
    json.replace(at, 1, "\\u003c");
  return json;
}

/// A script or style sheet escaped so that it cannot end its element; such text occurs only within strings.
std::string safe_text(std::string_view text) {
  std::string safe(text);
  for (const std::string_view start : {"</script", "</style", "<!--"})
    for (std::size_t at = safe.find(start); at != std::string::npos; at = safe.find(start, at))
      safe.insert(at + 1, 1, '\\');
  return safe;
}

std::string data_block(std::string_view id, std::string_view type, const std::string& content) {
  return "<script type=\"" + std::string(type) + "\" id=\"" + std::string(id) + "\">" + content + "</script>\n";
}

/// The path as played in a direction.
Path directed(Path path, PathDirection direction) {
  if (direction == PathDirection::Forward) return path;
  std::reverse(path.moves.begin(), path.moves.end());
  for (Move& move : path.moves) move.frames = reversed(std::move(move.frames));
  return path;
}

}  // namespace

Result<std::string> offline_page(const Assembly& assembly, const Path& path, const ViewerFiles& files,
                                 const OfflinePageOptions& options) {
  const Result<std::string> model = packed_model(assembly, options.progress);
  if (!model) return model.error();
  const double tolerance = path.tolerance > 0 ? path.tolerance : default_tolerance(assembly);
  const auto* icon = reinterpret_cast<const std::uint8_t*>(files.icon.data());

  std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  page += "<meta http-equiv=\"Content-Security-Policy\" content=\"" + std::string(kPolicy) + "\">\n";
  page += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  page += "<meta name=\"color-scheme\" content=\"light dark\">\n<meta name=\"generator\" content=\"dismantle\">\n";
  page += "<title>" + html_escaped(assembly.source_file) + "</title>\n";
  page += "<link rel=\"icon\" href=\"data:image/svg+xml;base64," + base64({icon, files.icon.size()}) + "\">\n";
  page += "<style>\n" + safe_text(files.style) + safe_text(files.offline) + "</style>\n</head>\n";
  page += "<body><p id=\"boot\">dismantle</p>\n";
  page += data_block("offline-assembly", "application/json", safe_json(viewer_model_json(assembly, tolerance)));
  page += data_block("offline-path", "application/json", safe_json(path_text(directed(path, options.direction))));
  page += data_block("offline-model", "text/plain", *model);
  page += "<script type=\"module\">\n" + safe_text(files.script) + "</script>\n</body>\n</html>\n";
  return page;
}

}  // namespace dismantle
