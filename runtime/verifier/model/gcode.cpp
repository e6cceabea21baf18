// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/gcode.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

namespace regulus::verifier {
namespace {

constexpr std::size_t kMostDigitsOfWord = 400;
constexpr std::string_view kDigits = "0123456789";

/// The modal groups of RS274/NGC; a line has at most one word of each.
enum Group : std::size_t {
  kMotion,
  kPlane,
  kUnits,
  kDistance,
  kCentres,
  kStop,
  kDwell,
  kRadius,
  kLength,
  kOrigin,
  kPathControl,
  kFeed,
  kSpindleMode,
  kSpindle,
  kCoolant,
  kOverrides,
  kGroups
};

struct Member {
  Group group;
  std::initializer_list<long> words;  ///< times ten
};

/// All words G, and all words M, that are known; the groups behind kStop, M0 and M1 change no path.
/// See "G Codes" and "M Codes" of LinuxCNC, and NISTIR 6556.
const Member* find_member(bool is_g, long word) {
  static constexpr Member kWordsG[] = {{kMotion, {0, 10, 20, 30, 800}},
                                       {kPlane, {170, 180, 190}},
                                       {kUnits, {200, 210}},
                                       {kDistance, {900, 910}},
                                       {kCentres, {901, 911}},
                                       {kDwell, {40}},
                                       {kRadius, {400}},
                                       {kLength, {490}},
                                       {kOrigin, {540}},
                                       {kPathControl, {610}},
                                       {kFeed, {940, 950}},
                                       {kSpindleMode, {960, 970}}};
  static constexpr Member kWordsM[] = {{kStop, {0, 10, 20, 300}},
                                       {kSpindle, {30, 40, 50}},
                                       {kCoolant, {70, 80, 90}},
                                       {kOverrides, {480, 490}}};
  const auto find = [word](const auto& members) -> const Member* {
    for (const Member& member : members)
      if (std::find(member.words.begin(), member.words.end(), word) != member.words.end())
        return &member;
    return nullptr;
  };
  return is_g ? find(kWordsG) : find(kWordsM);
}

constexpr long kNoMotion = 800;

bool is_blank(char c) { return c == ' ' || c == '\t'; }
char capital(char c) { return char('a' <= c && c <= 'z' ? c - 'a' + 'A' : c); }

/// Reads a program line by line and keeps the state of the machine.
class ProgramReader {
 public:
  std::vector<ProgramMove> read(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    while (!text.empty() && !ended_) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      ++line_;
      begin_line(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (moves_.empty()) stop("the program has no move from a known position");
    return std::move(moves_);
  }

 private:
  [[noreturn]] void stop(const std::string& why) const {
    throw Unfinished("line " + std::to_string(line_) + " of the program: " + why);
  }

  /// A line of a percent sign alone ends a program that began with one.
  void begin_line(std::string_view line) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    if (line.empty()) return;
    if (line.find('\r') != std::string_view::npos) stop("a carriage return is inside of the line");
    const bool is_first = std::exchange(is_first_, false);
    if (line == "%") {
      if (!is_first && !is_framed_) stop("a percent sign ends what none began");
      ended_ = is_framed_;
      is_framed_ = true;
      return;
    }
    read_words(line);
    execute();
  }

  void read_words(std::string_view line) {
    words_.fill(std::nullopt);
    modes_.fill(std::nullopt);
    if (line.front() == '/')
      stop("a switch of the controller decides about a line that begins with /");
    for (std::size_t at = 0; at < line.size();) {
      if (is_blank(line[at])) {
        ++at;
      } else if (line[at] == '(' || line[at] == ';') {
        at = behind_comment(line, at);
      } else {
        const bool is_first = at == 0;
        const char letter = capital(line[at]);
        const std::size_t begin = ++at;
        const Rational value = read_number(line, at);
        const std::string_view number = line.substr(begin, at - begin);
        if (letter != 'N')
          take(letter, value, number);
        else if (!is_first || number.find_first_of("+-.") != std::string_view::npos)
          stop("N is not the number of a line");
      }
    }
  }

  std::size_t behind_comment(std::string_view line, std::size_t at) const {
    const bool is_closed = line[at] == '(';
    const std::size_t end = is_closed ? line.find(')', at) : line.size();
    if (end == std::string_view::npos) stop("a comment is not closed");
    std::string_view comment = line.substr(at + 1, end - at - 1);
    if (is_closed && comment.find('(') != std::string_view::npos) stop("a comment is in a comment");
    while (!comment.empty() && is_blank(comment.front())) comment.remove_prefix(1);
    std::string name(comment.substr(0, std::min(comment.find(','), comment.size())));
    std::transform(name.begin(), name.end(), name.begin(), capital);
    if (name == "PY" || name == "ABORT") stop("a comment acts on the program");
    return is_closed ? end + 1 : end;
  }

  /// Reads from `at`, and moves it behind the number.
  Rational read_number(std::string_view line, std::size_t& at) const {
    while (at < line.size() && is_blank(line[at])) ++at;
    const std::size_t end = std::min(line.find_first_not_of("+-.0123456789", at), line.size());
    std::string text(line.substr(at, end - at));
    at = end;
    const bool is_negative = text.starts_with('-');
    if (is_negative || text.starts_with('+')) text.erase(0, 1);
    const std::size_t point = std::min(text.find('.'), text.size());
    const std::size_t decimals = point == text.size() ? 0 : text.size() - point - 1;
    if (point < text.size()) text.erase(point, 1);
    if (text.empty() || text.size() > kMostDigitsOfWord ||
        text.find_first_not_of(kDigits) != std::string::npos)
      stop("a word is not a letter and a number");
    Rational value;
    fmpz_set_str(fmpq_numref(value.get()), text.c_str(), 10);
    fmpz_ui_pow_ui(fmpq_denref(value.get()), 10, decimals);
    fmpq_canonicalise(value.get());
    return is_negative ? Rational(-1) * value : value;
  }

  void take(char letter, const Rational& value, std::string_view number) {
    if (letter == 'G' || letter == 'M') {
      const long word = tenths(letter, value, number);
      const Member* member = find_member(letter == 'G', word);
      if (member == nullptr) stop_at(letter, number);
      if (modes_[member->group]) stop("two words of one modal group");
      modes_[member->group] = word;
      return;
    }
    const std::size_t k = kLetters.find(letter);
    if (k == std::string_view::npos) stop_at(letter, number);
    if (words_[k]) stop(std::string("the word ") + letter + " is given twice");
    if (k >= kFirstWithoutEffect && value.sign() < 0) stop_at(letter, number);
    if (letter == 'T' && !value.is_integer()) stop_at(letter, number);
    words_[k] = value;
  }

  [[noreturn]] void stop_at(char letter, std::string_view number) const {
    stop("the word " + (letter + std::string(number.substr(0, 20))) + " is not known");
  }

  [[nodiscard]] long tenths(char letter, const Rational& value, std::string_view number) const {
    const Rational result = value * Rational(10);
    if (!result.is_integer() || result.sign() < 0 || result.bits() > 20) stop_at(letter, number);
    return fmpz_get_si(fmpq_numref(result.get()));
  }

  [[nodiscard]] bool has(char letter) const { return bool(words_[kLetters.find(letter)]); }
  [[nodiscard]] bool has_one_of(std::string_view letters) const {
    return std::any_of(letters.begin(), letters.end(), [this](char c) { return has(c); });
  }

  /// The words of a line act in the order of execution of RS274/NGC, not in that of the line.
  void execute() {
    if (bool(modes_[kDwell]) != has('P')) stop("G4 and P do not belong together");
    if (has('D') && modes_[kSpindleMode] != 960) stop("the word D belongs to no G96");
    plane_ = modes_[kPlane].value_or(plane_);
    if (modes_[kUnits]) unit_ = modes_[kUnits] == 200 ? Rational(127) / Rational(5) : Rational(1);
    is_relative_ = modes_[kDistance].value_or(is_relative_ ? 910 : 900) == 910;
    has_absolute_centres_ = modes_[kCentres].value_or(has_absolute_centres_ ? 901 : 911) == 901;
    mode_ = modes_[kMotion].value_or(mode_);
    const bool begins_arc = modes_[kMotion] && is_arc();
    if (begins_arc || has_one_of("XYZIJK")) move();
    ended_ = modes_[kStop] && *modes_[kStop] >= 20;
  }

  [[nodiscard]] bool is_arc() const { return mode_ == 20 || mode_ == 30; }

  void move() {
    if (mode_ == kNoMotion) stop("coordinates are given where no move is in force");
    if (!is_arc() && has_one_of("IJK")) stop("a straight move has a centre");
    std::array<std::optional<Rational>, 3> target = position_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!words_[axis]) continue;
      const Rational value = *words_[axis] * unit_;
      if (is_relative_ && !position_[axis]) stop("a relative move begins at an unknown position");
      target[axis] = is_relative_ ? *position_[axis] + value : value;
    }
    const bool is_known = position_[0] && position_[1] && position_[2];
    if (is_arc() && has('P')) stop("the word P of an arc makes further turns");
    if (!is_known && is_arc()) stop("an arc begins at an unknown position");
    if (is_known && (is_arc() || !(target == position_))) add(target);
    position_ = target;
  }

  void add(const std::array<std::optional<Rational>, 3>& target) {
    ProgramMove move;
    move.line = line_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      move.from[axis] = *position_[axis];
      move.to[axis] = *target[axis];
    }
    move.is_arc = is_arc();
    if (move.is_arc) set_arc(move);
    moves_.push_back(std::move(move));
  }

  void set_arc(ProgramMove& move) const {
    move.is_clockwise = mode_ == 20;
    if (plane_ == 180) move.axes = {2, 0, 1};
    if (plane_ == 190) move.axes = {1, 2, 0};
    if (words_[3 + move.axes[2]]) stop("the centre of an arc is outside of its plane");
    int given = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t axis = move.axes[k];
      const std::optional<Rational>& word = words_[3 + axis];
      given += word ? 1 : 0;
      move.centre[k] = has_absolute_centres_ ? Rational(0) : move.from[axis];
      if (word) move.centre[k] = move.centre[k] + *word * unit_;
    }
    if (given < (has_absolute_centres_ ? 2 : 1)) stop("the centre of an arc is not given");
    require_circle(move);
  }

  void require_circle(const ProgramMove& move) const;

  /// The letters that a line may have, each once; those from F on change no path.
  static constexpr std::string_view kLetters = "XYZIJKFSTPD";
  static constexpr std::size_t kFirstWithoutEffect = 6;

  std::vector<ProgramMove> moves_;
  std::array<std::optional<Rational>, 3> position_;             ///< in mm
  std::array<std::optional<Rational>, kLetters.size()> words_;  ///< of the line, by kLetters
  std::array<std::optional<long>, kGroups> modes_;              ///< of the line, times ten
  Rational unit_{1};                                            ///< in mm
  long mode_ = kNoMotion, plane_ = 170;
  std::size_t line_ = 0;
  bool is_relative_ = false, has_absolute_centres_ = false, ended_ = false;
  bool is_first_ = true, is_framed_ = false;
};

/// The arc of a move, relative to its centre.
struct Arc {
  Rational from_x, from_y, to_x, to_y;

  explicit Arc(const ProgramMove& move)
      : from_x(move.from[move.axes[0]] - move.centre[0]),
        from_y(move.from[move.axes[1]] - move.centre[1]),
        to_x(move.to[move.axes[0]] - move.centre[0]),
        to_y(move.to[move.axes[1]] - move.centre[1]) {}

  [[nodiscard]] Rational cross() const { return from_x * to_y - from_y * to_x; }
  [[nodiscard]] Rational dot() const { return from_x * to_x + from_y * to_y; }
  [[nodiscard]] Rational first_square() const { return from_x * from_x + from_y * from_y; }
  [[nodiscard]] Rational last_square() const { return to_x * to_x + to_y * to_y; }
};

/// Controllers refuse radii that differ too much, and make a whole turn if the ends are very near to
/// each other.
void ProgramReader::require_circle(const ProgramMove& move) const {
  const Arc arc(move);
  if (arc.first_square().is_zero() || arc.last_square().is_zero()) stop("an arc has a radius of 0");
  const double first = std::sqrt(fmpq_get_d(arc.first_square().get()));
  const double last = std::sqrt(fmpq_get_d(arc.last_square().get()));
  if (!(std::fabs(first - last) <= std::max(0.01, 1e-3 * first)))
    stop("the ends of an arc are not equally far from its centre");
  const Rational cross = arc.cross();
  const Rational size = cross.sign() < 0 ? Rational(-1) * cross : cross;
  if (size.sign() != 0 && (arc.dot() - size * Rational(1'000'000)).sign() > 0)
    stop("an arc cannot be told from a whole turn");
}

/// Returns the angle of the arc: from 0 to 2·pi, or from −2·pi to 0 if it is clockwise, and not 0.
NodeId turn_of(Graph& graph, const Arc& arc, bool is_clockwise) {
  const Rational cross = arc.cross(), dot = arc.dot();
  const auto times_pi = [&graph](long factor) {
    return graph.add(Op::kMultiply, graph.number(Rational(factor)), graph.add(Op::kPi));
  };
  const long way = is_clockwise ? -1 : 1;
  if (cross.sign() == 0) return times_pi(dot.sign() > 0 ? 2 * way : way);
  const NodeId angle = angle_of(graph, cross, dot);
  return cross.sign() == way ? angle : graph.add(Op::kAdd, angle, times_pi(2 * way));
}

/// Returns 1 − |from|/|to|.
NodeId miss_of(Graph& graph, const Arc& arc) {
  const Rational from = arc.first_square(), to = arc.last_square();
  if (from == to) return graph.number(Rational(0));
  return graph.add(Op::kSubtract, graph.number(Rational(1)),
                   graph.add(Op::kSqrt, graph.number(from / to)));
}

}  // namespace

std::vector<ProgramMove> read_program(std::string_view text) { return ProgramReader().read(text); }

NodeId place_on_move(Graph& graph, const ProgramMove& move, std::size_t axis) {
  const auto plus = [&graph](NodeId a, NodeId b) { return graph.add(Op::kAdd, a, b); };
  const auto times = [&graph](NodeId a, NodeId b) { return graph.add(Op::kMultiply, a, b); };
  const NodeId s = graph.add(Op::kVariable, 0);
  if (!move.is_arc || axis == move.axes[2])
    return plus(graph.number(move.from[axis]),
                times(graph.number(move.to[axis] - move.from[axis]), s));
  const Arc arc(move);
  const bool is_first = axis == move.axes[0];
  const NodeId angle = times(turn_of(graph, arc, move.is_clockwise), s);
  const NodeId cosine = graph.add(Op::kCos, angle), sine = graph.add(Op::kSin, angle);
  const NodeId turned = is_first ? plus(times(graph.number(arc.from_x), cosine),
                                        times(graph.number(Rational(-1) * arc.from_y), sine))
                                 : plus(times(graph.number(arc.from_y), cosine),
                                        times(graph.number(arc.from_x), sine));
  const NodeId missed =
      times(times(graph.number(is_first ? arc.to_x : arc.to_y), miss_of(graph, arc)), s);
  return plus(graph.number(move.centre[is_first ? 0 : 1]), plus(turned, missed));
}

}  // namespace regulus::verifier
