// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/gltf/gltf_container.h"

#include "dismantle/formats/import/mesh_source.h"

#include <cstdint>
#include <cstring>

namespace dismantle {

namespace {

constexpr std::string_view kMagic = "glTF";
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr std::size_t kHeaderSize = 12, kChunkHeaderSize = 8;
constexpr std::string_view kBase64Mark = ";base64,";

std::uint32_t load_u32(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

Error broken(const std::string& name, const std::string& why, const std::string& advice = "export it again") {
  return {ErrorKind::Unreadable, name + " cannot be read as glTF (" + why + "); " + advice};
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  return c == '/' || c == '_' ? 63 : -1;
}

/// None if it is not base64.
std::optional<std::string> from_base64(std::string_view text) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    const int digit = base64_digit(c);
    if (digit < 0) return std::nullopt;
    bits = (bits << 6 | static_cast<std::uint32_t>(digit)) & 0xffffffu;
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<char>(bits >> held & 0xffu));
  }
  return bytes;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// Decodes percent escapes; other characters are unchanged.
std::string percent_decoded(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const int high = i + 2 < uri.size() && uri[i] == '%' ? hex_digit(uri[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(uri[i + 2]) : -1;
    text.push_back(low >= 0 ? static_cast<char>(high * 16 + low) : uri[i]);
    if (low >= 0) i += 2;
  }
  return text;
}

/// True for URIs with a scheme ("http:...", "file:...") and for absolute paths.
bool is_elsewhere(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  return uri.substr(0, 1) == "/" || (colon != std::string_view::npos && uri.find('/') > colon);
}

Result<std::string> load_uri(const std::string& uri, const std::string& name, const GltfFileLoader& load,
                             std::size_t limit) {
  if (uri.substr(0, 5) == "data:") {
    const std::size_t mark = uri.find(kBase64Mark);
    std::optional<std::string> bytes;
    if (mark != std::string::npos) bytes = from_base64(std::string_view(uri).substr(mark + kBase64Mark.size()));
    if (!bytes) return broken(name, "a data URI is no base64");
    return std::move(*bytes);
  }
  if (is_elsewhere(uri))
    return broken(name, "it refers to " + in_quotes(uri) + ", and nothing is fetched from elsewhere",
                  "put the file beside it and refer to it by name");
  return load(percent_decoded(uri), limit);
}

}  // namespace

Result<GltfContainer> open_gltf_container(std::string_view bytes, const std::string& name) {
  if (bytes.substr(0, kMagic.size()) != kMagic) return GltfContainer{bytes, std::nullopt};
  if (bytes.size() < kHeaderSize + kChunkHeaderSize) return broken(name, "it ends within its header");
  if (load_u32(bytes, 4) != 2)
    return broken(name, "binary glTF of version " + std::to_string(load_u32(bytes, 4)), "export it as glTF 2");
  const std::size_t length = load_u32(bytes, 8);
  if (length > bytes.size() || length < kHeaderSize) return broken(name, "it is shorter than its header says");
  bytes = bytes.substr(0, length);

  GltfContainer container;
  for (std::size_t at = kHeaderSize; bytes.size() - at >= kChunkHeaderSize;) {
    const std::size_t size = load_u32(bytes, at);
    const std::uint32_t kind = load_u32(bytes, at + 4);
    at += kChunkHeaderSize;
    if (size > bytes.size() - at) return broken(name, "a chunk reaches beyond the end");
    if (at == kHeaderSize + kChunkHeaderSize && kind != kJsonChunk) return broken(name, "its first chunk is no JSON");
    if (kind == kJsonChunk && container.json.empty()) container.json = bytes.substr(at, size);
    if (kind == kBinaryChunk && !container.binary) container.binary = bytes.substr(at, size);
    at += size;
  }
  return container;
}

Result<GltfBuffers> load_gltf_buffers(const GltfDocument& document, const GltfContainer& container,
                                      const std::string& name, const GltfFileLoader& load, std::size_t limit) {
  GltfBuffers buffers;
  std::size_t total = 0;
  for (std::size_t i = 0; i < document.buffers.size(); ++i) {
    const GltfBuffer& buffer = document.buffers[i];
    std::string_view bytes;
    if (buffer.uri) {
      Result<std::string> loaded = load_uri(*buffer.uri, name, load, limit - total);
      if (!loaded) return loaded.error();
      bytes = buffers.owned.emplace_back(std::move(*loaded));
      total += bytes.size();
      if (total > limit) return broken(name, "its buffers are too long", "split it");
    } else if (i == 0 && container.binary) {
      bytes = *container.binary;
    } else {
      return broken(name, "buffer " + std::to_string(i) + " has no bytes");
    }
    if (bytes.size() < buffer.length)
      return broken(name, "buffer " + std::to_string(i) + " has " + std::to_string(bytes.size()) + " bytes of " +
                              std::to_string(buffer.length));
    buffers.bytes.push_back(bytes.substr(0, buffer.length));
  }
  return buffers;
}

}  // namespace dismantle
