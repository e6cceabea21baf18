// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/file/toml_limits.hpp"

#include <algorithm>

#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

/// Scans the text just enough to recognise strings, comments, keys and values. It agrees with the
/// library up to the first mistake in the text, where the library stops.
class Scan {
 public:
  Scan(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  void run() {
    while (at_ < text_.size()) step();
  }

 private:
  void step() {
    const char c = text_[at_];
    if (c == '"' || c == '\'') return skip_string(c);
    if (c == '#') return skip_to(text_.find('\n', at_));
    ++at_;
    switch (c) {
      case '\n':
        return end_line();
      case '[':
      case '{':
        return open();
      case ']':
      case '}':
        if (nesting_ > 0) --nesting_;
        return end_key(!in_value_);
      case '=':
        in_value_ = true;
        return end_key(true);
      case ',':
        return end_key(false);
      case '.':
        return count_part();
      default:
        return;
    }
  }

  void end_line() {
    ++line_;
    if (nesting_ == 0) in_value_ = false;
    dots_ = 0;
  }

  /// Outside a value a bracket begins a table's name.
  void open() {
    dots_ = 0;
    if (!in_value_) return;
    if (++nesting_ > kMaxTomlNesting)
      refuse("values nested too deeply",
             std::to_string(kMaxTomlNesting) + " levels of [ ] and { }");
  }

  void count_part() {
    if (++dots_ >= kMaxKeyParts)
      refuse("a key of too many parts", std::to_string(kMaxKeyParts) + " parts, as a.b.c has 3");
  }

  /// Ends the text since the last structural character, which was a key or a value.
  void end_key(bool key) {
    if (key && dots_ > 0) tables_ += dots_ + 1;
    dots_ = 0;
    if (tables_ > kMaxTomlTables)
      refuse("too many dotted keys and tables", std::to_string(kMaxTomlTables) + " parts in all");
  }

  void skip_to(std::size_t end) {
    end = std::min(end, text_.size());
    line_ += static_cast<int>(
        std::count(text_.begin() + std::ptrdiff_t(at_), text_.begin() + std::ptrdiff_t(end), '\n'));
    at_ = end;
  }

  void skip_string(char quote) {
    const std::string thrice(3, quote);
    const bool many_lines = text_.substr(at_, 3) == thrice;
    std::size_t end = at_ + (many_lines ? 3 : 1);
    while (end < text_.size()) {
      if (quote == '"' && text_[end] == '\\')
        end += 2;
      else if (many_lines ? text_.substr(end, 3) == thrice : text_[end] == quote)
        break;
      else if (!many_lines && text_[end] == '\n')
        return skip_to(end);  // a mistake: the string is not closed
      else
        ++end;
    }
    end += many_lines ? 3 : 1;
    // Two more quotes may precede the three that close.
    for (int more = 0; many_lines && more < 2 && end < text_.size() && text_[end] == quote; ++more)
      ++end;
    skip_to(end);
  }

  [[noreturn]] void refuse(const std::string& found, const std::string& most) const {
    throw InputError(file_, line_, found, "at most " + most);
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
  int line_ = 1;
  bool in_value_ = false;
  std::size_t nesting_ = 0;
  std::size_t dots_ = 0;  // since the last structural character
  std::size_t tables_ = 0;
};

}  // namespace

void require_toml_limits(std::string_view text, const std::string& file) { Scan(text, file).run(); }

}  // namespace regulus::detail
