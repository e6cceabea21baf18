// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {
namespace {

/// True if a character in UTF-8 could change what a terminal shows of the others: C1, the separators
/// of lines and paragraphs, and the bidirectional controls of Unicode Standard Annex #9.
bool hides_text(std::string_view line) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const auto byte = [&](std::size_t k) {
      return i + k < line.size() ? static_cast<unsigned char>(line[i + k]) : 0U;
    };
    const unsigned first = byte(0), second = byte(1), third = byte(2);
    if ((first == 0xc2 && second < 0xa0) || (first == 0xd8 && second == 0x9c)) return true;
    if (first != 0xe2) continue;
    if (second == 0x80 && (third == 0x8e || third == 0x8f || (third >= 0xa8 && third <= 0xae)))
      return true;
    if (second == 0x81 && third >= 0xa6 && third <= 0xa9) return true;
  }
  return false;
}

}  // namespace

bool Lines::next() {
  if (!std::exchange(repeats_, false)) has_line_ = read();
  if (has_line_ && keeps_) kept_.push_back(text_);
  if (has_line_ && digest_ != nullptr) digest_->add(text_ + '\n');
  return has_line_;
}

bool Lines::read() {
  text_.clear();
  ++number_;
  named_ = 0;
  for (int c; (c = in_.get()) != std::istream::traits_type::eof();) {
    if (left_-- == 0) throw Rejection("the file is too large");
    if (c == '\n') {
      if (hides_text(text_)) throw Rejection("the line contains a control character");
      return true;
    }
    if (c < ' ' || c == 127) throw Rejection("the line contains a control character");
    if (text_.size() == format::kLongestLine) throw Rejection("the line is too long");
    text_.push_back(char(c));
  }
  if (in_.bad()) throw std::runtime_error("the file cannot be read");
  if (!text_.empty()) throw Rejection("the last line has no newline");
  return false;
}

}  // namespace regulus::verifier
