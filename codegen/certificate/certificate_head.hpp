// SPDX-License-Identifier: GPL-3.0-or-later
// The first part of a certificate, as lines, and the whole of it all the same.
#pragma once

#include <istream>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

namespace regulus::inline certificate {

/// A certificate whose head, up to the line `proof`, has been read from a stream that need not go
/// back: a pipe will do.
class CertificateHead {
 public:
  /// Reads no further than the head. One of more than kLongestHead bytes, or with control
  /// characters, which would end up in messages, has no lines here.
  explicit CertificateHead(std::istream& file);

  static constexpr std::size_t kLongestHead = std::size_t{1} << 26;

  /// From the first one to the one before `proof`; empty if there is no such line.
  [[nodiscard]] const std::vector<std::string>& lines() const noexcept { return lines_; }
  /// What follows `key` and a space in the first line that begins with them; empty if none does.
  [[nodiscard]] std::string_view value(std::string_view key) const;
  /// Everything that was read, to be followed by what is left of the stream.
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  std::string text_;
  std::vector<std::string> lines_;
};

/// What a line says after `key` and a space; empty if it begins with something else.
[[nodiscard]] std::string_view value_of(std::string_view line, std::string_view key);

/// Some text, and then what is left of another stream. Both must outlive it.
class ContinuedText : public std::streambuf {
 public:
  ContinuedText(const std::string& text, std::istream& rest);

 private:
  int_type underflow() override;

  std::istream& rest_;
  std::vector<char> buffer_;
};

}  // namespace regulus::certificate
