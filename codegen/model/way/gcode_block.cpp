// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/way/gcode_block.hpp"

#include <algorithm>
#include <utility>

#include "codegen/model/exact/decimal.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using GiNaC::numeric;

struct KnownWord {
  std::string_view word;
  GcodeGroup group;
  bool has_effect;
};

/// All words G and M that are known. G54 is the origin of the model, G40 and G49 cancel what is not
/// known, and M6, M60 and words of the user may move the axes.
constexpr KnownWord kKnownWords[] = {
    {"G0", GcodeGroup::kMotion, true},        {"G1", GcodeGroup::kMotion, true},
    {"G2", GcodeGroup::kMotion, true},        {"G3", GcodeGroup::kMotion, true},
    {"G80", GcodeGroup::kMotion, true},       {"G17", GcodeGroup::kPlane, true},
    {"G18", GcodeGroup::kPlane, true},        {"G19", GcodeGroup::kPlane, true},
    {"G20", GcodeGroup::kUnits, true},        {"G21", GcodeGroup::kUnits, true},
    {"G90", GcodeGroup::kDistance, true},     {"G91", GcodeGroup::kDistance, true},
    {"G90.1", GcodeGroup::kCentres, true},    {"G91.1", GcodeGroup::kCentres, true},
    {"M2", GcodeGroup::kStop, true},          {"M30", GcodeGroup::kStop, true},
    {"M0", GcodeGroup::kStop, false},         {"M1", GcodeGroup::kStop, false},
    {"G4", GcodeGroup::kDwell, false},        {"G40", GcodeGroup::kRadius, false},
    {"G49", GcodeGroup::kLength, false},      {"G54", GcodeGroup::kOrigin, false},
    {"G61", GcodeGroup::kPathControl, false}, {"G94", GcodeGroup::kFeed, false},
    {"G95", GcodeGroup::kFeed, false},        {"G96", GcodeGroup::kSpindleMode, false},
    {"G97", GcodeGroup::kSpindleMode, false}, {"M3", GcodeGroup::kSpindle, false},
    {"M4", GcodeGroup::kSpindle, false},      {"M5", GcodeGroup::kSpindle, false},
    {"M7", GcodeGroup::kCoolant, false},      {"M8", GcodeGroup::kCoolant, false},
    {"M9", GcodeGroup::kCoolant, false},      {"M48", GcodeGroup::kOverrides, false},
    {"M49", GcodeGroup::kOverrides, false},
};

/// Letters with a number: of a move, and of words without an effect on the path.
constexpr std::string_view kOfMove = "XYZIJK", kWithoutEffect = "FSTPD";

struct Refusal {
  std::string_view word, why, remedy;
};

/// What is often met, in words of its own.
constexpr Refusal kRefusals[] = {
    {"G64", "lets the controller round the corners of the path",
     "write G61, and give what the controller leaves of the path as the error of the motion"},
    {"R", "of an arc: the radius R leaves two circles", "write the centre with I, J or K"},
    {"O", "calls, repeats or leaves out parts of the program",
     "write the moves one after the other"},
    {"M98", "calls a part of the program", "write the moves one after the other"},
};

bool is_blank(char c) { return c == ' ' || c == '\t'; }

char upper(char c) { return 'a' <= c && c <= 'z' ? char(c - 'a' + 'A') : c; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Returns "G1" for "01" and "1.0", and "G90.1"; the text itself for other numbers.
std::string word_of(char letter, const numeric& value, std::string_view text) {
  std::string word(1, letter);
  const numeric tenths = value * 10;
  if (!tenths.is_integer() || value.is_negative() || value > 10000) return word.append(text);
  const int count = tenths.to_int();
  word.append(std::to_string(count / 10));
  if (count % 10 != 0) word.append(1, '.').append(1, char('0' + count % 10));
  return word;
}

class LineReader {
 public:
  LineReader(const std::string& file, std::string_view rest, int line) : file_(file), rest_(rest) {
    block_.line = line;
  }

  GcodeBlock read() {
    skip_blanks();
    if (rest_.starts_with('/'))
      fail("a line that begins with / is left out if a switch of the controller says so",
           "delete the / or the line");
    if (!rest_.empty() && upper(rest_.front()) == 'N') take_line_number();
    while (!rest_.empty()) {
      if (rest_.front() == '(' || rest_.front() == ';')
        take_comment();
      else
        take_word();
      skip_blanks();
    }
    require_owners();
    return std::move(block_);
  }

 private:
  void skip_blanks() {
    while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
  }

  std::string_view take(std::size_t count) {
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(taken.size());
    return taken;
  }

  void take_line_number() {
    take(1);
    skip_blanks();
    const std::size_t end = rest_.find_first_not_of("0123456789");
    if (take(std::min(end, rest_.size())).empty())
      fail("the line number N has no number", "write digits alone after N");
    block_.without_effect.insert("N");
    skip_blanks();
  }

  void take_comment() {
    const bool to_end = take(1) == ";";
    const std::size_t end = to_end ? rest_.size() : rest_.find(')');
    if (end == std::string_view::npos) fail("a comment is not closed", "write ( and )");
    const std::string_view comment = take(end);
    if (!to_end) take(1);
    if (!to_end && comment.find('(') != std::string_view::npos)
      fail("a comment has a comment in it", "close it with ) before the next (");
    std::string begin(trimmed(comment).substr(0, 6));
    std::transform(begin.begin(), begin.end(), begin.begin(), upper);
    if (begin.starts_with("PY,") || begin == "ABORT,")
      fail("a comment of LinuxCNC that begins with 'py,' or 'abort,' acts on the program",
           "delete it");
  }

  void take_word() {
    const std::string_view from = rest_.substr(0, 20);
    const char letter = upper(take(1).front());
    skip_blanks();
    const std::size_t end = std::min(rest_.find_first_not_of("+-.0123456789"), rest_.size());
    const std::string_view text = take(end);
    const auto value = signed_decimal(text);
    if (letter < 'A' || letter > 'Z' || !value)
      fail("found " + in_quotes(from) + ", which is not a letter and a number",
           "write words such as G1 X10.5; parameters, expressions and checksums are not read");
    if (letter == 'G' || letter == 'M')
      add_mode(word_of(letter, *value, text));
    else
      add_number(letter, *value);
  }

  void add_mode(const std::string& word) {
    const auto* known = std::ranges::find(kKnownWords, word, &KnownWord::word);
    if (known == std::end(kKnownWords)) refuse(word);
    const auto [other, is_new] = block_.modes.emplace(known->group, word);
    if (!is_new)
      fail("the words " + other->second + " and " + word + " cannot be on one line",
           "write one of them, or two lines");
    if (!known->has_effect) block_.without_effect.insert(word);
  }

  void add_number(char letter, const numeric& value) {
    const bool has_effect = kOfMove.find(letter) != std::string_view::npos;
    if (!has_effect && kWithoutEffect.find(letter) == std::string_view::npos)
      refuse(std::string(1, letter));
    if (!block_.numbers.emplace(letter, value).second)
      fail(std::string("the word ") + letter + " is given twice", "give it once");
    if (has_effect) return;
    if (value.is_negative() || (letter == 'T' && !value.is_integer()))
      fail(std::string("the word ") + letter + " has a number that it cannot have",
           letter == 'T' ? "write the number of a tool" : "write a number that is not negative");
    block_.without_effect.insert(std::string(1, letter));
  }

  /// P and D mean different things beside different words.
  void require_owners() const {
    const bool dwells = !block_.mode(GcodeGroup::kDwell).empty();
    if (dwells && !block_.has('P')) fail("G4 has no time", "write it with P, such as G4 P0.5");
    if (block_.has('P') && !dwells)
      fail("the word P belongs to no G4; that of an arc makes further turns",
           "write P with G4 alone, and each turn of an arc as a move");
    if (block_.has('D') && block_.mode(GcodeGroup::kSpindleMode) != "G96")
      fail("the word D belongs to no G96", "delete it; a tool's radius is not read");
  }

  [[noreturn]] void refuse(const std::string& word) const {
    for (const Refusal& known : kRefusals)
      if (known.word == word)
        fail("the word " + word + ' ' + std::string(known.why), std::string(known.remedy));
    if (std::string_view("ABCUVW").find(word) != std::string_view::npos)
      fail("the axis " + word + " is not moved by this reader",
           "use a table of way-points for motions that turn the platform");
    fail("the word " + word + " is not one of those that are read: it may change the path",
         "write the path as moves G0 to G3; MODEL_FILES.md lists the words without an effect");
  }

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw InputError::statement(file_, block_.line, problem, remedy);
  }

  const std::string& file_;
  std::string_view rest_;
  GcodeBlock block_;
};

}  // namespace

std::string GcodeBlock::mode(GcodeGroup group) const {
  const auto found = modes.find(group);
  return found == modes.end() ? "" : found->second;
}

GcodeText::GcodeText(std::string file, std::string_view text)
    : file_(std::move(file)), rest_(text) {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
}

std::string_view GcodeText::take_line() {
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  ++line_;
  if (line.ends_with('\r')) line.remove_suffix(1);
  if (line.find('\r') != std::string_view::npos)
    throw InputError::statement(file_, line_, "a carriage return is inside of the line",
                                "end each line with a line feed, or with both");
  return line;
}

/// RS274/NGC: if the first line that is not blank is %, the second such line ends the program.
bool GcodeText::is_end(std::string_view line) {
  const bool is_frame = trimmed(line) == "%";
  if (is_frame && has_begun_ && !is_framed_)
    throw InputError::statement(file_, line_, "a line % ends a program that no line % began",
                                "write % above the first line, or delete it");
  const bool is_second = is_frame && is_framed_;
  is_framed_ = is_framed_ || is_frame;
  has_begun_ = has_begun_ || !trimmed(line).empty();
  return is_second;
}

std::optional<GcodeBlock> GcodeText::next() {
  if (rest_.empty()) return std::nullopt;
  const std::string_view line = take_line();
  if (is_end(line)) {
    rest_ = {};
    return std::nullopt;
  }
  return LineReader(file_, trimmed(line) == "%" ? "" : line, line_).read();
}

}  // namespace regulus::detail
