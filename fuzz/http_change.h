// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuzz/http_site.h"
#include "fuzz/structured_change.h"

#include <string>
#include <string_view>
#include <vector>

/// Changes of what a client sends over a connection: of its requests and headers, and of the frames after an upgrade.
namespace dismantle::fuzz {

/// A frame of a client, masked.
struct ClientFrame {
  unsigned opcode = 1;
  bool is_final = true, is_masked = true;
  std::string payload;

  /// The bytes of the frame. `length_bytes`: in how many the length is given, if it fits: 0, 2 or 8.
  std::string bytes(std::size_t length_bytes = 0) const {
    static constexpr char kMask[] = {0x11, 0x22, 0x33, 0x44};
    std::string result(1, static_cast<char>((is_final ? 0x80u : 0u) | opcode));
    std::size_t size = payload.size();
    if (length_bytes == 0 && size >= 126) length_bytes = size < 65536 ? 2 : 8;
    const std::size_t code = length_bytes == 0 ? size : length_bytes == 2 ? 126 : 127;
    result += static_cast<char>((is_masked ? 0x80u : 0u) | code);
    for (std::size_t i = length_bytes; i-- > 0;) result += static_cast<char>(size >> (8 * i));
    if (is_masked) result.append(kMask, sizeof kMask);
    for (std::size_t i = 0; i < size; ++i)
      result += static_cast<char>(is_masked ? payload[i] ^ kMask[i % sizeof kMask] : payload[i]);
    return result;
  }
};

/// Changes an input of fuzz_http, whose first two bytes say in which pieces it arrives.
class HttpChange {
 public:
  HttpChange(std::string& text, Choices& choices) : text_(text), choices_(choices) {
    if (text_.size() < kFront) text_.resize(kFront);
    // Where frames begin, if there are some.
    const std::size_t upgrade = text_.find("Sec-WebSocket-Key");
    const std::size_t head_end = upgrade == std::string::npos ? upgrade : text_.find("\r\n\r\n", upgrade);
    frames_ = head_end == std::string::npos ? text_.size() : head_end + 4;
  }

  /// Makes one change.
  void make() {
    const bool has_frames = frames_ < text_.size() || text_.find("Sec-WebSocket-Key") != std::string::npos;
    if (has_frames && choices_.below(2) == 0) return change_frames();
    switch (choices_.below(10)) {
      case 0:
        text_[choices_.below(kFront)] = static_cast<char>(choices_.below(256));
        return;
      case 1:
        text_.resize(kFront + choices_.below(text_.size() - kFront + 1));
        return;
      case 2:
        return change_plain_bytes();
      case 3:
      case 4:
        return insert_request();
      case 5:
        return change_first_line();
      case 6:
        return change_body();
      default:
        return change_header();
    }
  }

 private:
  static constexpr std::size_t kFront = 2;

  void change_plain_bytes() {
    std::string rest = text_.substr(kFront);
    change_bytes(rest, rest.size() + 64);
    text_.replace(kFront, std::string::npos, rest);
  }

  std::string target() {
    static const std::string kTargets[] = {"/",
                                           "/index.html",
                                           "/link.html",
                                           "/up/secret.html",
                                           "/../secret.html",
                                           "/%2e%2e/secret.html",
                                           "//",
                                           "/index.html/",
                                           "/api/model.glb",
                                           "/api/path.json?name=a%0d%0aX%3a%20b",
                                           "/api/export?name=%ff%22%5c.glb",
                                           "/api/guide.json",
                                           "/api/open?name=a.obj",
                                           "/api/open_files",
                                           "/api/guide?name=p",
                                           "/session?client=00112233445566778899aabbccddeeff",
                                           "/session?client=",
                                           "/session",
                                           "*",
                                           "http://127.0.0.1:1234/",
                                           "/%00",
                                           "/%",
                                           "/?a=b&a=c&&=",
                                           "/" + std::string(9000, 'a')};
    return choices_.of(kTargets);
  }

  std::string header_line() {
    static const std::string kLines[] = {"Host: 127.0.0.1:1234",
                                         "Host: localhost:1234",
                                         "Host: evil.example:1234",
                                         "Host:",
                                         "Origin: http://127.0.0.1:1234",
                                         "Origin: null",
                                         "Authorization: Bearer " + kToken,
                                         "Authorization: Bearer " + kToken + "0",
                                         "authorization:\r\n Bearer " + kToken,
                                         "Connection: close",
                                         "Connection: keep-alive",
                                         "Connection: Upgrade",
                                         "Upgrade: websocket",
                                         "Upgrade: h2c",
                                         "Sec-WebSocket-Version: 13",
                                         "Sec-WebSocket-Version: 8",
                                         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
                                         "Sec-WebSocket-Key: short",
                                         "Sec-WebSocket-Protocol: dismantle.1, token." + kToken,
                                         "Sec-WebSocket-Protocol: dismantle.1, token.",
                                         "Sec-WebSocket-Extensions: permessage-deflate",
                                         "Content-Length: 0",
                                         "Content-Length: 5",
                                         "Content-Length: 30000",
                                         "Content-Length: 18446744073709551615",
                                         "Content-Length: -1",
                                         "Content-Length: 5, 5",
                                         "Transfer-Encoding: chunked",
                                         "Transfer-Encoding: gzip, chunked",
                                         "Expect: 100-continue",
                                         "X-Client: " + kController,
                                         "X-Long: " + std::string(9000, 'x'),
                                         "X-Empty:",
                                         "NoColon",
                                         " folded",
                                         "X-\x01: \xff\x80",
                                         "Range: bytes=0-1"};
    return choices_.of(kLines);
  }

  std::string request() {
    static constexpr std::string_view kMethods[] = {"GET",     "GET", "GET", "POST",   "HEAD",
                                                    "OPTIONS", "PUT", "get", "CONNECT"};
    std::string text =
        std::string(choices_.of(kMethods)) + ' ' + target() + (choices_.below(8) == 0 ? " HTTP/1.0" : " HTTP/1.1");
    text += "\r\nHost: 127.0.0.1:1234";
    if (choices_.below(2) == 0) text += "\r\nAuthorization: Bearer " + kToken + "\r\nX-Client: " + kController;
    for (std::size_t more = choices_.below(3); more > 0; --more) text += "\r\n" + header_line();
    return text + "\r\n\r\n";
  }

  /// At the begin of a request, or at the end of all.
  void insert_request() {
    std::vector<std::size_t> places{kFront, text_.size()};
    for (std::size_t at = text_.find("\r\n\r\n"); at != std::string::npos; at = text_.find("\r\n\r\n", at + 1))
      places.push_back(at + 4);
    text_.insert(choices_.of(places), request());
  }

  /// The lines of requests, without their ends.
  std::vector<TextRange> lines() const {
    std::vector<TextRange> result;
    for (std::size_t begin = kFront; begin < frames_;) {
      const std::size_t end = text_.find("\r\n", begin);
      if (end == std::string::npos || end > frames_) break;
      if (end > begin) result.push_back({begin, end});
      begin = end + 2;
    }
    return result;
  }

  void replace(TextRange range, std::string_view by) { text_.replace(range.begin, range.size(), by); }

  void change_header() {
    const std::vector<TextRange> all = lines();
    if (all.empty()) return;
    const TextRange line = choices_.of(all);
    const std::string same = text_.substr(line.begin, line.size());
    switch (choices_.below(5)) {
      case 0:
        return replace({line.begin, std::min(line.end + 2, text_.size())}, "");
      case 1:
        return replace(line, header_line());
      case 2:
        return replace(line, same + "\r\n" + same);
      case 3:
        return replace({line.end, line.end + 2}, choices_.below(2) == 0 ? "\n" : "\r\n\t ");
      default:
        return replace(line, same + "\r\n" + header_line());
    }
  }

  void change_first_line() {
    std::vector<TextRange> all = lines();
    std::erase_if(all, [this](TextRange line) {
      return text_.substr(line.begin, line.size()).find(" HTTP/") == std::string::npos;
    });
    if (all.empty()) return;
    const TextRange line = choices_.of(all);
    static constexpr std::string_view kVersions[] = {"HTTP/1.1", "HTTP/1.0", "HTTP/2.0", "HTTP/1.1 ", "HTTP/0.9", ""};
    const std::string same = text_.substr(line.begin, line.size());
    replace(line, same.substr(0, same.find(' ')) + ' ' + target() + ' ' + std::string(choices_.of(kVersions)));
  }

  /// An upload with a body that is whole, short, long or chunked.
  void change_body() {
    const std::size_t size = choices_.below(choices_.below(2) == 0 ? 200 : 25'000),
                      said = choices_.below(4) == 0 ? choices_.below(30'000) : size;
    std::string text = "POST " + target() + " HTTP/1.1\r\nHost: 127.0.0.1:1234\r\nAuthorization: Bearer " + kToken +
                       "\r\nX-Client: " + kController + "\r\n";
    if (choices_.below(5) == 0)
      text += "Transfer-Encoding: chunked\r\n\r\n5;a=b\r\nabcde\r\nffffffffffffffff\r\n0\r\n\r\n";
    else
      text += "Content-Length: " + std::to_string(said) + "\r\n\r\n" + std::string(size, 'b');
    text_.resize(kFront + choices_.below(2) * (frames_ - kFront));
    text_ += text;
  }

  std::string payload() {
    static const std::string kPayloads[] = {R"({"id":1,"command":"broadcast"})",
                                            R"({"id":2,"command":"metrics"})",
                                            R"({"id":3,"command":"fail"})",
                                            R"({"id":1,"command":"take_control"})",
                                            R"({"id":18446744073709551615,"command":"state"})",
                                            R"({"id":4,"command":"hold","components":[0]})",
                                            R"({"id":-1,"command":"state"})",
                                            R"({"id":5,"command":"\ud800\u0000"})",
                                            "{",
                                            "",
                                            "[" + std::string(200, '['),
                                            std::string(300, 'a'),
                                            "\xff\xfe",
                                            "\xc3\xa4",
                                            std::string(1, '\x03') + "\xe8",
                                            "\x03\xe8 bye",
                                            std::string(65536, '1'),
                                            server::encode(server::TargetMessage{1, 1, {}}),
                                            server::encode(server::RateMessage{})};
    return choices_.of(kPayloads);
  }

  std::string frame() {
    static constexpr unsigned kOpcodes[] = {1, 1, 1, 2, 0, 8, 9, 10, 3, 15};
    static constexpr std::size_t kLengths[] = {0, 0, 0, 2, 8};
    ClientFrame frame{choices_.of(kOpcodes), choices_.below(5) != 0, choices_.below(12) != 0, payload()};
    std::string bytes = frame.bytes(choices_.of(kLengths));
    if (choices_.below(12) == 0)
      bytes[0] = static_cast<char>(bytes[0] ^ (0x10 << choices_.below(3)));  // a reserved bit
    return bytes;
  }

  /// The frames as far as they can be told apart.
  std::vector<TextRange> frames() const {
    std::vector<TextRange> result;
    for (std::size_t begin = frames_; begin + 2 <= text_.size();) {
      const auto byte = [this](std::size_t i) { return i < text_.size() ? static_cast<unsigned char>(text_[i]) : 0u; };
      std::size_t length = byte(begin + 1) & 0x7fu, header = 2;
      if (length >= 126) {
        header = length == 126 ? 4 : 10;
        length = 0;
        for (std::size_t i = 2; i < header; ++i) length = length << 8 | byte(begin + i);
      }
      if ((byte(begin + 1) & 0x80u) != 0) header += 4;
      if (length > text_.size() || begin + header + length > text_.size()) break;
      result.push_back({begin, begin + header + length});
      begin += header + length;
    }
    return result;
  }

  void change_frames() {
    const std::vector<TextRange> all = frames();
    if (all.empty()) {
      text_ += frame();
      return;
    }
    const TextRange one = choices_.of(all);
    const std::string same = text_.substr(one.begin, one.size());
    switch (choices_.below(7)) {
      case 0:
        return replace(one, "");
      case 1:
        return replace(one, same + same);
      case 2:
        return replace(one, frame());
      case 3:
        text_[one.begin] = static_cast<char>(text_[one.begin] ^ 0x80);  // the last of a message, or not
        return;
      case 4:
        text_[one.begin] = static_cast<char>((text_[one.begin] & 0xf0) | static_cast<char>(choices_.below(16)));
        return;
      default:
        text_.insert(choices_.below(2) == 0 ? one.begin : one.end, frame());
    }
  }

  std::string& text_;
  Choices& choices_;
  std::size_t frames_ = 0;
};

}  // namespace dismantle::fuzz
