// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/file/source_lines.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kStride = 64;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool begins_character(char c) noexcept { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }

}  // namespace

SourceLines::SourceLines(std::string_view text) : text_(text), first_of_line_{0} {
  std::size_t characters = 0;
  for (std::size_t at = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
       at < text.size(); ++at) {
    if (!begins_character(text[at])) continue;
    if (characters % kStride == 0) bytes_.push_back(at);
    ++characters;
    if (text[at] == '\n') first_of_line_.push_back(characters);
  }
}

std::size_t SourceLines::offset(std::size_t line, std::size_t column) const noexcept {
  if (line == 0 || column == 0 || line > first_of_line_.size()) return text_.size();
  const std::size_t character = first_of_line_[line - 1] + column - 1;
  if (character / kStride >= bytes_.size()) return text_.size();
  std::size_t at = bytes_[character / kStride];
  for (std::size_t steps = character % kStride; steps > 0 && at < text_.size(); --steps) do
      ++at;
    while (at < text_.size() && !begins_character(text_[at]));
  return at;
}

}  // namespace regulus::detail
