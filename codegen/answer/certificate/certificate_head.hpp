// SPDX-License-Identifier: GPL-3.0-or-later
// The first part of a certificate as lines, and access to the complete text.
#pragma once

#include <istream>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

namespace regulus {

/// A certificate whose head, up to the line `proof`, has been read from a stream. The stream need
/// not be seekable, so it may be a pipe.
class CertificateHead {
 public:
  /// Reads no further than the head. lines() is empty if the head is longer than kLongestHead
  /// bytes, or has control characters, which would appear in messages.
  explicit CertificateHead(std::istream& file);

  static constexpr std::size_t kLongestHead = std::size_t{1} << 26;

  /// The lines before `proof`; empty if there is no such line.
  [[nodiscard]] const std::vector<std::string>& lines() const noexcept { return lines_; }
  /// Returns the text after `key` and a space in the first such line; empty if there is none.
  [[nodiscard]] std::string_view value(std::string_view key) const;
  /// Returns all text that was read; the rest of the stream follows it.
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  std::string text_;
  std::vector<std::string> lines_;
};

/// Returns the text after `key` and a space; empty if the line does not begin with them.
[[nodiscard]] std::string_view value_of(std::string_view line, std::string_view key);

/// Some text, followed by the rest of another stream. Both must outlive it.
class ContinuedText : public std::streambuf {
 public:
  ContinuedText(const std::string& text, std::istream& rest);

 private:
  int_type underflow() override;

  std::istream& rest_;
  std::vector<char> buffer_;
};

}  // namespace regulus
