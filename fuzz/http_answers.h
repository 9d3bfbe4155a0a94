// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/wire.h"
#include "fuzz/fuzz_input.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

/// A second reading of what went over a connection, independent of Beast: it knows as much of HTTP and WebSockets as
/// the server may send, and of requests as much as it takes to see whether they have the token.
namespace dismantle::fuzz {

inline std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// The lines of a head: of a request or a response, up to its empty line.
struct HttpHead {
  std::string first_line;
  std::vector<std::pair<std::string, std::string>>
      headers;  ///< Names in lower case, values without spaces around them.

  /// The values of all headers of that name.
  std::vector<std::string> all(std::string_view name) const {
    std::vector<std::string> values;
    for (const auto& [header, value] : headers)
      if (header == name) values.push_back(value);
    return values;
  }
};

inline HttpHead head_of(std::string text) {
  // Lines that go on in the next one, which begins with a space (RFC 7230, "obs-fold").
  for (std::size_t at = 0; (at = text.find("\r\n", at)) != std::string::npos;) {
    const std::size_t next = at + 2;
    if (next < text.size() && (text[next] == ' ' || text[next] == '\t'))
      text.replace(at, 2, " ");
    else
      at = next;
  }
  HttpHead head;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find("\r\n", begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    if (begin == 0) {
      head.first_line = line;
    } else if (const std::size_t colon = line.find(':'); colon != std::string::npos) {
      const std::size_t first = line.find_first_not_of(" \t", colon + 1), last = line.find_last_not_of(" \t");
      head.headers.emplace_back(lower(line.substr(0, colon)),
                                first == std::string::npos ? "" : line.substr(first, last + 1 - first));
    }
    begin = end + 2;
  }
  return head;
}

/// The heads of the requests of a connection, in order. What follows the head of a request with a body is none, but the
/// server answers nothing after such a request.
inline std::vector<HttpHead> requests_in(const std::string& sent) {
  std::vector<HttpHead> requests;
  for (std::size_t begin = 0;;) {
    const std::size_t end = sent.find("\r\n\r\n", begin);
    if (end == std::string::npos) return requests;
    requests.push_back(head_of(sent.substr(begin, end - begin)));
    begin = end + 4;
  }
}

struct HttpAnswer {
  unsigned status = 0;
  HttpHead head;
  std::string body;
};

/// The bytes that the server sent, as answers; those after an answer 101 are WebSocket frames.
struct Received {
  std::vector<HttpAnswer> answers;
  std::string frames;
};

/// Takes apart what the server sent, and checks that it is HTTP.
inline Received answers_in(const std::string& bytes, const std::vector<HttpHead>& requests) {
  Received received;
  for (std::size_t begin = 0; begin < bytes.size();) {
    const std::size_t end = bytes.find("\r\n\r\n", begin);
    require(end != std::string::npos, "an answer with a whole head");
    HttpAnswer answer{0, head_of(bytes.substr(begin, end - begin)), {}};
    begin = end + 4;
    const std::string& line = answer.head.first_line;
    require(line.size() >= 13 && line.starts_with("HTTP/1.1 ") && line[12] == ' ', "a status line");
    for (std::size_t i = 9; i < 12; ++i) {
      require(std::isdigit(static_cast<unsigned char>(line[i])) != 0, "a status of digits");
      answer.status = 10 * answer.status + static_cast<unsigned>(line[i] - '0');
    }
    for (const char* name : {"content-security-policy", "x-content-type-options", "cross-origin-opener-policy",
                             "cross-origin-embedder-policy", "cross-origin-resource-policy", "referrer-policy"})
      require(answer.head.all(name).size() == 1, "the security headers in every answer");
    require(received.answers.size() < requests.size(), "no answer without a request");
    if (answer.status == 101) {
      received.answers.push_back(std::move(answer));
      received.frames = bytes.substr(begin);
      return received;
    }
    const std::vector<std::string> length = answer.head.all("content-length");
    require(length.size() == 1 && length[0].size() < 10, "an answer with a length");
    const std::size_t size = std::stoul(length[0]);
    require(bytes.size() - begin >= size, "an answer with its whole body");
    answer.body = bytes.substr(begin, size);
    begin += size;
    received.answers.push_back(std::move(answer));
  }
  return received;
}

/// A WebSocket frame of the server.
struct ServerFrame {
  unsigned opcode = 0;
  std::string payload;
};

/// Takes frames apart, and checks that a server may send them (RFC 6455).
inline std::vector<ServerFrame> frames_in(std::string_view bytes) {
  std::vector<ServerFrame> frames;
  while (!bytes.empty()) {
    require(bytes.size() >= 2, "a whole frame");
    const auto byte = [&bytes](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
    const unsigned opcode = byte(0) & 15u;
    require((byte(0) & 0xf0u) == 0x80u, "a frame that is a message, without extensions");
    require(opcode == 1 || opcode == 2 || (opcode >= 8 && opcode <= 10), "a known kind of frame");
    require((byte(1) & 0x80u) == 0, "a frame without a mask");
    std::size_t length = byte(1), header = 2;
    if (length >= 126) {
      header = length == 126 ? 4 : 10;
      require(opcode < 8 && bytes.size() >= header, "a whole frame");
      length = 0;
      for (std::size_t i = 2; i < header; ++i) length = length << 8 | byte(i);
    }
    require(bytes.size() - header >= length, "a whole frame");
    require(frames.empty() || frames.back().opcode != 8, "nothing after a close");
    frames.push_back({opcode, std::string(bytes.substr(header, length))});
    bytes.remove_prefix(header + length);
  }
  return frames;
}

/// The messages are those of docs/wire.md.
inline void require_messages(const std::vector<ServerFrame>& frames) {
  for (const auto& [opcode, payload] : frames) {
    if (opcode == 1) {
      const auto json = nlohmann::json::parse(payload, nullptr, false);
      require(is_utf8(payload) && json.is_object(), "a text that is a JSON object");
      require(json.contains("event") || json.contains("reply"), "an event or a reply");
    } else if (opcode == 2) {
      require(server::decode_pose(payload).has_value(), "bytes that are a pose");
    } else if (opcode == 8) {
      require(payload.size() != 1, "a close with a whole code");
    }
  }
}

}  // namespace dismantle::fuzz
