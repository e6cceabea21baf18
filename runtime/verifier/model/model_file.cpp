// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/model_file.hpp"

#include <algorithm>

#include "runtime/verifier/infix_reader.hpp"

namespace regulus::verifier {
namespace {

constexpr int kMostDepth = 64;
constexpr std::size_t kMostValues = 1 << 18;

bool is_bare(char c) noexcept { return is_digit(c) || is_letter(c) || c == '_' || c == '-'; }

class TomlScanner {
 public:
  explicit TomlScanner(std::string_view text) : text_(text) {}

  WrittenValues read() {
    std::string table;
    for (skip(true); at_ < text_.size(); skip(true)) {
      if (take('[')) {
        const bool is_list = take('[');
        table = key();
        expect(']');
        if (is_list) {
          expect(']');
          table += element(lists_[table]++);
        }
      } else {
        pair(table);
      }
      skip(false);
      if (at_ < text_.size() && text_[at_] != '\n') fail("the end of the line");
    }
    return std::move(values_);
  }

 private:
  static std::string element(std::size_t number) {
    std::string result("[");
    result += std::to_string(number);
    result += ']';
    return result;
  }

  void pair(const std::string& table) {
    std::string place = table;
    if (!place.empty()) place += '.';
    place += key();
    expect('=');
    value(place);
  }

  /// Reads names with dots between them.
  std::string key() {
    std::string result;
    do {
      skip(false);
      if (!result.empty()) result += '.';
      if (at_ < text_.size() && (text_[at_] == '"' || text_[at_] == '\'')) {
        const std::string name = string();
        if (name.find_first_of(".[]") != std::string::npos)
          fail("a name without dots and brackets");
        result += name;
        continue;
      }
      const std::size_t begin = at_;
      while (at_ < text_.size() && is_bare(text_[at_])) ++at_;
      if (at_ == begin) fail("a name");
      result += text_.substr(begin, at_ - begin);
    } while (take('.'));
    return result;
  }

  void value(const std::string& place) {
    if (++depth_ > kMostDepth) fail("fewer levels");
    skip(false);
    if (take('['))
      list(place);
    else if (take('{'))
      table(place);
    else
      scalar(place);
    --depth_;
  }

  void list(const std::string& place) {
    std::size_t number = 0;
    for (skip(true); !take(']'); skip(true)) {
      std::string inner = place;
      inner += element(number++);
      value(inner);
      skip(true);
      if (!take(',') && (at_ == text_.size() || text_[at_] != ']')) fail("a comma or ]");
    }
  }

  void table(const std::string& place) {
    for (skip(true); !take('}'); skip(true)) {
      pair(place);
      skip(true);
      if (!take(',') && (at_ == text_.size() || text_[at_] != '}')) fail("a comma or }");
    }
  }

  void scalar(const std::string& place) {
    WrittenValue result;
    result.line = line_;
    if (at_ < text_.size() && (text_[at_] == '"' || text_[at_] == '\'')) {
      result.is_string = true;
      result.text = string();
    } else {
      const std::size_t begin = at_;
      while (at_ < text_.size() && (is_bare(text_[at_]) || text_[at_] == '+' || text_[at_] == '.'))
        ++at_;
      if (at_ == begin) fail("a value");
      result.text = text_.substr(begin, at_ - begin);
    }
    if (values_.size() == kMostValues) fail("fewer values");
    result.number = values_.size();
    if (!values_.emplace(place, std::move(result)).second) fail("a name that is not used yet");
  }

  std::string string() {
    const char quote = text_[at_];
    const std::string three(3, quote);
    const bool is_long = text_.substr(at_, 3) == three;
    at_ += is_long ? 3 : 1;
    if (is_long && text_.substr(at_, 2) == "\r\n") ++at_;
    if (is_long && at_ < text_.size() && text_[at_] == '\n') ++at_, ++line_;
    std::string result;
    for (;;) {
      if (at_ == text_.size()) fail("the end of a string");
      if (is_long ? text_.substr(at_, 3) == three : text_[at_] == quote) break;
      const char c = text_[at_++];
      if (c == '\n' && !is_long) fail("the end of a string");
      if (c == '\n') ++line_;
      if (c == '\\' && quote == '"')
        escape(result);
      else
        result += c;
    }
    at_ += is_long ? 3 : 1;
    // Up to two quotes may come before the last three.
    while (is_long && at_ < text_.size() && text_[at_] == quote) result += quote, ++at_;
    return result;
  }

  void escape(std::string& result) {
    if (at_ == text_.size()) fail("the end of a string");
    const char c = text_[at_++];
    constexpr std::string_view kNames = "btnfr\"\\", kMeanings = "\b\t\n\f\r\"\\";
    if (const std::size_t known = kNames.find(c); known != std::string_view::npos) {
      result += kMeanings[known];
    } else if (c == 'u' || c == 'U') {
      append_code_point(code_point(c == 'u' ? 4 : 8), result);
    } else if (c == '\n' || c == ' ') {
      if (c == '\n') ++line_;
      while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n'))
        line_ += text_[at_++] == '\n';
    } else {
      fail("a character instead of \\" + std::string(1, c));
    }
  }

  /// Reads that many hexadecimal digits.
  unsigned long code_point(std::size_t digits) {
    unsigned long value = 0;
    for (std::size_t i = 0; i < digits; ++i) {
      constexpr std::string_view kHexDigits = "0123456789abcdef";
      const char c = at_ < text_.size() ? text_[at_] : ' ';
      const std::size_t digit = kHexDigits.find('A' <= c && c <= 'F' ? char(c - 'A' + 'a') : c);
      if (digit == std::string_view::npos) fail(std::to_string(digits) + " hexadecimal digits");
      value = 16 * value + digit;
      ++at_;
    }
    if (value > 0x10ffff || (0xd800 <= value && value < 0xe000)) fail("a character of Unicode");
    return value;
  }

  /// Appends the character in UTF-8.
  static void append_code_point(unsigned long value, std::string& result) {
    if (value < 0x80) {
      result += char(value);
      return;
    }
    const int rest = value < 0x800 ? 1 : value < 0x10000 ? 2 : 3;
    constexpr int kFirst[] = {0, 0xc0, 0xe0, 0xf0};
    result += char(kFirst[rest] | int(value >> (6 * rest)));
    for (int i = rest; i-- > 0;) result += char(0x80 | int((value >> (6 * i)) & 0x3f));
  }

  /// Skips spaces and comments; if `lines` is true, also the ends of lines.
  void skip(bool lines) {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#')
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      else if (c == ' ' || c == '\t' || c == '\r')
        ++at_;
      else if (c == '\n' && lines)
        ++at_, ++line_;
      else
        return;
    }
  }

  bool take(char c) {
    skip(false);
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!take(c)) fail(std::string(1, c));
  }
  [[noreturn]] void fail(const std::string& expected) const {
    throw Unfinished("line " + std::to_string(line_) + " of the model file: expected " + expected);
  }

  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
  int depth_ = 0;
  std::map<std::string, std::size_t> lists_;
  WrittenValues values_;
};

NodeId whole_number(std::string digits, int base, Graph& graph) {
  Rational value;
  if (digits.empty() || fmpz_set_str(fmpq_numref(value.get()), digits.c_str(), base) != 0)
    throw Unfinished("'" + digits + "' is not a number");
  return graph.number(value);
}

}  // namespace

WrittenValues read_model_values(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return TomlScanner(text).read();
}

NodeId number_of_toml(std::string_view text, Graph& graph) {
  std::string digits;
  for (const char c : text)
    if (c != '_') digits += c == 'E' ? 'e' : c;
  const bool negative = digits.starts_with('-');
  if (negative || digits.starts_with('+')) digits.erase(0, 1);
  NodeId node = kNoNode;
  if (digits.starts_with("0x"))
    node = whole_number(digits.substr(2), 16, graph);
  else if (digits.starts_with("0o"))
    node = whole_number(digits.substr(2), 8, graph);
  else if (digits.starts_with("0b"))
    node = whole_number(digits.substr(2), 2, graph);
  else if (digits.find_first_not_of("0123456789.e+-") != std::string::npos)
    throw Unfinished("'" + std::string(text) + "' is not a number");
  else
    node = graph.number(digits);
  return negative ? graph.add(Op::kNegate, node) : node;
}

namespace {

bool is_degrees(const WrittenValue& unit) { return unit.text == "deg" || unit.text == "°"; }

/// Adds the joints of [serial] that turn, if its angles are in degrees.
void add_joints_in_degrees(const WrittenValues& values, Names& names) {
  const auto unit = values.find("serial.angle_unit");
  if (unit == values.end() || !is_degrees(unit->second)) return;
  for (const auto& [place, value] : values) {
    if (!place.starts_with("serial.joints[") || !place.ends_with("].name")) continue;
    const std::string joint = place.substr(0, place.size() - std::string_view("name").size());
    const auto type = values.find(joint + "type");
    if (type == values.end() || type->second.text != "prismatic") names.insert(value.text);
  }
}

}  // namespace

Names poses_in_degrees(const WrittenValues& values) {
  Names names;
  add_joints_in_degrees(values, names);
  for (const std::string_view table : {"pose.", "closure.unknowns."})
    for (auto at = values.lower_bound(table); at != values.end() && at->first.starts_with(table);
         ++at)
      if (is_degrees(at->second)) names.insert(at->first.substr(table.size()));
  for (const char* unit : {"gough.angle_unit", "legs.angle_unit"}) {
    const auto given = values.find(unit);
    if (given != values.end() && is_degrees(given->second))
      names.insert({"psi", "theta", "phi", "roll", "pitch", "yaw"});
  }
  return names;
}

}  // namespace regulus::verifier
