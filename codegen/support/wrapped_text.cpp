// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/support/wrapped_text.hpp"

#include <algorithm>

namespace regulus::detail {
namespace {

/// The column of the sentences of a report; see Facts.
constexpr std::size_t kColumnOfSentences = 11;
/// A narrower column would have a word on each line.
constexpr std::size_t kLeastWidth = 24;

/// Returns the number of characters in UTF-8.
std::size_t width_of(std::string_view text) {
  return std::size_t(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

/// Appends a line that begins in the column `first`, and breaks it at blanks.
void append_wrapped(std::string& text, std::string_view line, std::size_t first,
                    std::size_t columns, std::size_t indent) {
  std::size_t at = first;
  bool is_first = true;
  while (!line.empty()) {
    const std::size_t blanks = std::min(line.find_first_not_of(' '), line.size());
    const std::size_t end = std::min(line.find(' ', blanks), line.size());
    const std::string_view word = line.substr(blanks, end - blanks);
    if (!is_first && at + blanks + width_of(word) > columns) {
      text += '\n' + std::string(indent, ' ');
      at = indent;
    } else {
      text.append(blanks, ' ');
      at += blanks;
    }
    text += word;
    at += width_of(word);
    line.remove_prefix(end);
    is_first = false;
  }
}

std::size_t blanks_of(std::string_view line) {
  return std::min(line.find_first_not_of(' '), line.size());
}

/// Appends a line of a table; what does not fit goes on in the column `indent`.
void append_below(std::string& text, std::string_view line, std::size_t columns,
                  std::size_t indent) {
  if (width_of(line) <= columns || indent > line.size() || columns < indent + kLeastWidth) {
    text += line;
    return;
  }
  // The label, and the blanks after it, are no place for a break.
  text += line.substr(0, indent);
  append_wrapped(text, line.substr(indent), width_of(line.substr(0, indent)), columns, indent);
}

template <class Append>
std::string line_by_line(std::string_view text, const Append& append) {
  std::string result;
  for (;;) {
    const std::size_t end = text.find('\n');
    append(result, text.substr(0, end));
    if (end == std::string_view::npos) return result;
    result += '\n';
    text.remove_prefix(end + 1);
  }
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t columns, std::size_t indent) {
  bool is_first = true;
  return line_by_line(text, [&](std::string& to, std::string_view line) {
    if (!is_first && !line.empty()) to.append(indent, ' ');
    is_first = false;
    if (line.starts_with(' '))
      to += line;
    else
      append_wrapped(to, line, indent, std::max(columns, indent + kLeastWidth), indent);
  });
}

std::string wrapped_report(std::string_view report, std::size_t columns) {
  return line_by_line(report, [&](std::string& to, std::string_view line) {
    append_below(to, line, columns, std::max(kColumnOfSentences, blanks_of(line)));
  });
}

std::string wrapped_table(std::string_view text, std::size_t columns) {
  return line_by_line(text, [&](std::string& to, std::string_view line) {
    const std::size_t blanks = blanks_of(line), gap = line.find("  ", blanks);
    append_below(to, line, columns,
                 gap == std::string_view::npos ? blanks : line.find_first_not_of(' ', gap));
  });
}

}  // namespace regulus::detail
