// SPDX-License-Identifier: Apache-2.0
#include "runtime/certificate/verifier/gcode.hpp"

#include <algorithm>
#include <optional>
#include <string>

namespace regulus::verifier {
namespace {

constexpr std::size_t kMostDigitsOfWord = 400;
constexpr std::string_view kDigits = "0123456789";

/// Words of G that change no path, times ten.
constexpr long kWithoutEffect[] = {400, 490, 540, 610, 640, 800, 940, 950, 960, 970};

/// Reads a program line by line and keeps the state of the machine.
class ProgramReader {
 public:
  std::vector<ProgramMove> read(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    while (!text.empty() && !ended_) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      ++line_;
      read_line(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (moves_.empty()) stop("the program has no move from a known position");
    return std::move(moves_);
  }

 private:
  [[noreturn]] void stop(const std::string& why) const {
    throw Unfinished("line " + std::to_string(line_) + " of the program: " + why);
  }

  void read_line(std::string_view line) {
    words_.fill(std::nullopt);
    bool pauses = false;
    for (std::size_t at = 0; at < line.size() && line[at] != ';';) {
      if (line[at] == '(') {
        at = line.find(')', at);
        if (at == std::string_view::npos) stop("a comment is not closed");
        ++at;
      } else if (std::string_view(" \t\r%/").find(line[at]) != std::string_view::npos) {
        ++at;
      } else {
        const char letter =
            char('a' <= line[at] && line[at] <= 'z' ? line[at] - 'a' + 'A' : line[at]);
        const Rational value = read_number(line, ++at);
        take(letter, value, pauses);
      }
    }
    if (!pauses && std::any_of(words_.begin(), words_.end(), [](const auto& w) { return bool(w); }))
      move();
  }

  /// Reads from `at`, and moves it behind the number.
  Rational read_number(std::string_view line, std::size_t& at) const {
    at = std::min(line.find_first_not_of(' ', at), line.size());
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

  void take(char letter, const Rational& value, bool& pauses) {
    constexpr std::string_view kOfPath = "XYZIJK";
    if (letter == 'G') {
      const long word = tenths(value);
      pauses = pauses || word == 40;
      if (word != 40) set_mode(word);
    } else if (letter == 'M') {
      ended_ = ended_ || value == Rational(2) || value == Rational(30);
    } else if (const std::size_t k = kOfPath.find(letter); k != std::string_view::npos) {
      if (words_[k]) stop("a word is given twice");
      words_[k] = value;
    } else if (std::string_view("FSTNPHDEOQL").find(letter) == std::string_view::npos) {
      stop(std::string("the word ") + letter + " is not known");
    }
  }

  [[nodiscard]] long tenths(const Rational& value) const {
    const Rational result = value * Rational(10);
    if (!result.is_integer() || result.sign() < 0 || result.bits() > 20)
      stop("a word G is not known");
    return fmpz_get_si(fmpq_numref(result.get()));
  }

  void set_mode(long word) {
    if (word == 0 || word == 10 || word == 20 || word == 30)
      mode_ = word / 10;
    else if (word == 170 || word == 180 || word == 190)
      plane_ = word / 10;
    else if (word == 200 || word == 210)
      unit_ = word == 200 ? Rational(127) / Rational(5) : Rational(1);
    else if (word == 900 || word == 910)
      is_relative_ = word == 910;
    else if (word == 901 || word == 911)
      has_absolute_centres_ = word == 901;
    else if (std::find(std::begin(kWithoutEffect), std::end(kWithoutEffect), word) ==
             std::end(kWithoutEffect))
      stop("a word G is not known");
  }

  void move() {
    std::array<std::optional<Rational>, 3> target = position_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!words_[axis]) continue;
      const Rational value = *words_[axis] * unit_;
      if (is_relative_ && !position_[axis]) stop("a relative move begins at an unknown position");
      target[axis] = is_relative_ ? *position_[axis] + value : value;
    }
    const bool is_known = position_[0] && position_[1] && position_[2];
    if (!is_known && mode_ >= 2) stop("an arc begins at an unknown position");
    if (is_known && (mode_ >= 2 || !(target == position_))) add(target);
    position_ = target;
  }

  void add(const std::array<std::optional<Rational>, 3>& target) {
    ProgramMove move;
    move.line = line_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      move.from[axis] = *position_[axis];
      move.to[axis] = *target[axis];
    }
    move.is_arc = mode_ >= 2;
    if (move.is_arc) set_arc(move);
    moves_.push_back(std::move(move));
  }

  void set_arc(ProgramMove& move) const {
    move.is_clockwise = mode_ == 2;
    if (plane_ == 18) move.axes = {2, 0, 1};
    if (plane_ == 19) move.axes = {1, 2, 0};
    bool is_given = false;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t axis = move.axes[k];
      const std::optional<Rational>& word = words_[3 + axis];
      is_given = is_given || word;
      if (!word)
        move.centre[k] = move.from[axis];
      else
        move.centre[k] = *word * unit_ + (has_absolute_centres_ ? Rational(0) : move.from[axis]);
    }
    if (!is_given) stop("the centre of an arc is not given");
  }

  std::vector<ProgramMove> moves_;
  std::array<std::optional<Rational>, 3> position_;  ///< in mm
  std::array<std::optional<Rational>, 6> words_;     ///< of the line: X, Y, Z, I, J, K
  Rational unit_{1};                                 ///< in mm
  long mode_ = 0, plane_ = 17;
  std::size_t line_ = 0;
  bool is_relative_ = false, has_absolute_centres_ = false, ended_ = false;
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
};

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
  const Rational from = arc.from_x * arc.from_x + arc.from_y * arc.from_y;
  const Rational to = arc.to_x * arc.to_x + arc.to_y * arc.to_y;
  if (from.is_zero() || to.is_zero()) throw Unfinished("an arc of the program has a radius of 0");
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
