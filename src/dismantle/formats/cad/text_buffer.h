// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/progress.h"

#include <algorithm>
#include <cstddef>
#include <streambuf>
#include <string_view>

namespace dismantle {

/// A stream over text that reports how far it has been read.
class TextBuffer : public std::streambuf {
 public:
  TextBuffer(std::string_view text, const ProgressCallback& progress) : text_(text), progress_(progress) {}

 protected:
  int_type underflow() override {
    if (given_ == text_.size()) return traits_type::eof();
    report_progress(progress_, "reading", static_cast<double>(given_) / static_cast<double>(text_.size()));
    const std::size_t count = std::min(kPiece, text_.size() - given_);
    char* piece = const_cast<char*>(text_.data()) + given_;  // a get area is never written to
    setg(piece, piece, piece + count);
    given_ += count;
    return traits_type::to_int_type(*piece);
  }

  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode which) override {
    const auto here = static_cast<off_type>(given_) - (egptr() - gptr());
    const off_type base = from == std::ios_base::beg   ? 0
                          : from == std::ios_base::cur ? here
                                                       : static_cast<off_type>(text_.size());
    return seekpos(base + offset, which);
  }

  pos_type seekpos(pos_type position, std::ios_base::openmode which) override {
    const auto offset = static_cast<off_type>(position);
    if (!(which & std::ios_base::in) || offset < 0 || offset > static_cast<off_type>(text_.size()))
      return pos_type(off_type(-1));
    given_ = static_cast<std::size_t>(offset);
    setg(nullptr, nullptr, nullptr);  // the next character is fetched from there
    return position;
  }

 private:
  static constexpr std::size_t kPiece = 1 << 18;
  std::string_view text_;
  const ProgressCallback& progress_;
  std::size_t given_ = 0;
};

}  // namespace dismantle
