// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/gcode_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "codegen/model/decimal.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/read_file.hpp"
#include "codegen/model/units.hpp"
#include "codegen/model/waypoint_file.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/files/sha256.hpp"

namespace regulus::inline model {
namespace {

using GiNaC::ex;
using GiNaC::numeric;
using Words = std::vector<std::pair<char, numeric>>;

/// Two coordinates in the plane of an arc, relative to its centre.
struct Arm {
  numeric x, y;
  [[nodiscard]] numeric square() const { return x * x + y * y; }
};

class GcodeReader {
 public:
  GcodeReader(const Model& model, const Motion& motion, const std::string& file)
      : model_(model), motion_(motion), file_(file) {}

  Trajectory read() {
    const std::string text = read_file(file_, kLargestWaypointFile, Readable::kStream);
    result_.file = motion_.waypoints->shown.empty() ? file_ : motion_.waypoints->shown;
    result_.sha256 = sha256(text);
    result_.interpolation = "G-code";
    find_axes();
    std::string_view rest = text;
    if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
    while (!rest.empty() && !ended_) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      ++line_;
      run(words_of(rest.substr(0, end)));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    if (result_.pieces.empty())
      fail("the program has no move after x, y and z are known",
           "begin with a move to a whole position, such as G0 X0 Y0 Z50");
    if (has_rapid_)
      result_.notes.push_back("G0 is taken as a straight line; some controllers move otherwise");
    if (!ignored_.empty()) {
      const std::vector<std::string> words(ignored_.begin(), ignored_.end());
      result_.notes.push_back("words without an effect on the path: " + enumeration(words));
    }
    return std::move(result_);
  }

 private:
  void find_axes() {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string name(1, "xyz"[axis]);
      const auto at = std::ranges::find(model_.pose, name, &PoseParameter::name);
      const auto factor = at == model_.pose.end() ? std::nullopt : unit_factor("mm", at->unit);
      if (!factor)
        throw InputError::statement(file_, 0,
                                    "G-code moves x, y and z in units of length, and the model has "
                                    "no such " +
                                        name,
                                    "use a table of way-points");
      parameter_[axis] = std::size_t(at - model_.pose.begin());
      to_model_[axis] = GiNaC::ex_to<numeric>(*factor);
    }
    for (std::size_t i = 0; i < model_.pose.size(); ++i) {
      const bool moves = std::ranges::find(parameter_, i) != parameter_.end();
      held_.push_back(moves ? ex(0)
                            : held_value(model_, motion_, i, file_, 0,
                                         "give it a value in the motion: G-code has only x, y "
                                         "and z"));
    }
  }

  Words words_of(std::string_view line) const {
    Words words;
    for (std::size_t at = 0; at < line.size();) {
      const char c = line[at];
      if (c == ';') break;
      if (c == '(') {
        at = line.find(')', at);
        if (at == std::string_view::npos) fail("a comment is not closed", "write ( and )");
        ++at;
      } else if (c == ' ' || c == '\t' || c == '\r' || c == '%' || c == '/') {
        ++at;
      } else {
        at = read_word(line, at, words);
      }
    }
    return words;
  }

  std::size_t read_word(std::string_view line, std::size_t at, Words& words) const {
    const char c = line[at];
    const char letter = 'a' <= c && c <= 'z' ? char(c - 'a' + 'A') : c;
    std::size_t begin = at + 1;
    while (begin < line.size() && line[begin] == ' ') ++begin;
    std::size_t end = line.find_first_not_of("+-.0123456789", begin);
    end = std::min(end, line.size());
    const auto value = signed_decimal(line.substr(begin, end - begin));
    if (letter < 'A' || letter > 'Z' || !value)
      fail("found " + in_quotes(line.substr(at, 20)) + ", which is not a letter and a number",
           "write words such as G1 X10.5; parameters and expressions are not read");
    words.emplace_back(letter, *value);
    return end;
  }

  void run(const Words& words) {
    std::map<char, numeric> given;
    for (const auto& [letter, value] : words) {
      if (letter == 'G') {
        set_mode(value);
      } else if (letter == 'M') {
        ignored_.insert(shown(letter, value));
        ended_ = ended_ || value == 2 || value == 30;
      } else if (std::string_view("FSTNPHDEOQL").find(letter) != std::string_view::npos) {
        ignored_.insert(std::string(1, letter));
      } else if (std::string_view("XYZIJKR").find(letter) != std::string_view::npos) {
        if (!given.emplace(letter, value).second)
          fail(std::string("the word ") + letter + " is given twice", "give it once");
      } else {
        fail(std::string("the axis ") + letter + " is not moved by this reader",
             "use a table of way-points for motions that turn the platform");
      }
    }
    if (!given.empty() && !skips_) move(given);
    skips_ = false;
  }

  static std::string shown(char letter, const numeric& value) {
    const double number = value.to_double();
    const long tenths = std::lround(10 * number);
    return std::string(1, letter) + std::to_string(tenths / 10) +
           (tenths % 10 == 0 ? "" : "." + std::to_string(tenths % 10));
  }

  void set_mode(const numeric& value) {
    const std::string word = shown('G', value);
    if (word == "G0" || word == "G1" || word == "G2" || word == "G3")
      mode_ = word[1] - '0';
    else if (word == "G17" || word == "G18" || word == "G19")
      plane_ = word == "G17" ? 0 : word == "G18" ? 1 : 2;
    else if (word == "G20" || word == "G21")
      unit_ = word == "G20" ? numeric(254, 10) : numeric(1);
    else if (word == "G90" || word == "G91")
      is_relative_ = word == "G91";
    else if (word == "G90.1" || word == "G91.1")
      has_absolute_centres_ = word == "G90.1";
    else if (word == "G4")
      skips_ = true, ignored_.insert(word);
    else if (kWithoutEffect.contains(word))
      ignored_.insert(word);
    else
      fail("the word " + word + " changes the path in a way that is not read",
           "write the path in absolute or relative moves G0 to G3 alone");
  }

  void move(const std::map<char, numeric>& given) {
    std::array<std::optional<numeric>, 3> target = position_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto word = given.find("XYZ"[axis]);
      if (word == given.end()) continue;
      const numeric value = word->second * unit_;
      if (is_relative_ && !position_[axis])
        fail("a relative move begins at an unknown position",
             "begin with G90 and a whole position");
      target[axis] = is_relative_ ? numeric(*position_[axis] + value) : value;
    }
    const auto is_known = [](const auto& p) { return p[0] && p[1] && p[2]; };
    const bool is_first = !is_known(position_);
    if (is_first && mode_ >= 2)
      fail("an arc begins at an unknown position", "begin with a move such as G0 X0 Y0 Z50");
    if (!is_first) mode_ < 2 ? add_line(target) : add_arc(target, given);
    position_ = target;
  }

  TrajectoryPiece& add_piece() {
    TrajectoryPiece& piece = result_.pieces.emplace_back();
    if (result_.pieces.size() > kMostWaypoints)
      fail("there are more than " + std::to_string(kMostWaypoints) + " moves",
           "cut the program into several files");
    piece.first_line = piece.last_line = line_;
    const auto number = static_cast<std::int64_t>(result_.pieces.size());
    piece.begin = exact_integer(number - 1);
    piece.end = exact_integer(number);
    piece.pose.resize(model_.pose.size());
    for (std::size_t i = 0; i < held_.size(); ++i) piece.pose[i].power[0] = held_[i];
    return piece;
  }

  void set_line(TrajectoryPiece& piece, std::size_t axis, const numeric& from, const numeric& to) {
    PieceOfPose& p = piece.pose[parameter_[axis]];
    p.power[0] = from * to_model_[axis];
    p.power[1] = (to - from) * to_model_[axis];
  }

  void add_line(const std::array<std::optional<numeric>, 3>& target) {
    if (target == position_) return;
    has_rapid_ = has_rapid_ || mode_ == 0;
    TrajectoryPiece& piece = add_piece();
    for (std::size_t axis = 0; axis < 3; ++axis)
      set_line(piece, axis, *position_[axis], *target[axis]);
  }

  /// The first and the second axis of the plane, and the third. G18 has z before x.
  [[nodiscard]] std::array<std::size_t, 3> axes() const {
    constexpr std::array<std::array<std::size_t, 3>, 3> kAxes = {{{0, 1, 2}, {2, 0, 1}, {1, 2, 0}}};
    return kAxes[std::size_t(plane_)];
  }

  void add_arc(const std::array<std::optional<numeric>, 3>& target,
               const std::map<char, numeric>& given) {
    const auto [a, b, c] = axes();
    const auto centre = [&](std::size_t axis) -> numeric {
      const auto word = given.find("IJK"[axis]);
      const numeric base = has_absolute_centres_ ? numeric(0) : *position_[axis];
      if (word == given.end()) return has_absolute_centres_ ? *position_[axis] : base;
      return base + word->second * unit_;
    };
    if (given.contains('R') || !(given.contains("IJK"[a]) || given.contains("IJK"[b])))
      fail("the centre of the arc is not given",
           "write it with I, J or K; the radius R leaves two circles");
    const numeric x = centre(a), y = centre(b);
    const Arm from{*position_[a] - x, *position_[b] - y}, to{*target[a] - x, *target[b] - y};
    require_circle(from, to);
    TrajectoryPiece& piece = add_piece();
    set_line(piece, c, *position_[c], *target[c]);
    const ex turn = turn_between(from, to);
    // The end of the arc about the centre is `to` times |from|/|to|.
    const ex miss =
        from.square() == to.square() ? ex(0) : 1 - GiNaC::sqrt(ex(from.square() / to.square()));
    set_arc(piece.pose[parameter_[a]], to_model_[a], {x, from.x, -from.y, to.x * miss, turn});
    set_arc(piece.pose[parameter_[b]], to_model_[b], {y, from.y, from.x, to.y * miss, turn});
  }

  struct ArcOfAxis {
    numeric centre, cosine, sine;
    ex miss, turn;
  };
  static void set_arc(PieceOfPose& p, const numeric& factor, const ArcOfAxis& arc) {
    p.power[0] = arc.centre * factor;
    p.power[1] = arc.miss * factor;
    p.cosine = arc.cosine * factor;
    p.sine = arc.sine * factor;
    p.turn = arc.turn;
  }

  void require_circle(const Arm& from, const Arm& to) const {
    const double first = std::sqrt(from.square().to_double());
    const double last = std::sqrt(to.square().to_double());
    if (from.square().is_zero() || to.square().is_zero())
      fail("the arc has a radius of 0", "correct its centre");
    if (std::abs(first - last) > std::max(0.01, 1e-3 * first))
      fail("the ends of the arc are not equally far from its centre: " + std::to_string(first) +
               " mm and " + std::to_string(last) + " mm",
           "correct its centre; I, J and K are relative to the begin of the arc unless G90.1");
  }

  /// Returns the angle, exactly: clockwise (G2) it is negative. Equal ends are a whole turn.
  [[nodiscard]] ex turn_between(const Arm& from, const Arm& to) const {
    const numeric cross = from.x * to.y - from.y * to.x, dot = from.x * to.x + from.y * to.y;
    const bool is_clockwise = mode_ == 2;
    if (cross.is_zero() && dot.is_positive()) return ex(is_clockwise ? -2 : 2) * ex(GiNaC::Pi);
    if (cross.is_zero()) return ex(is_clockwise ? -1 : 1) * ex(GiNaC::Pi);
    const ex angle = GiNaC::atan2(cross, dot);
    if (is_clockwise && cross.is_positive()) return angle - ex(2) * ex(GiNaC::Pi);
    if (!is_clockwise && cross.is_negative()) return angle + ex(2) * ex(GiNaC::Pi);
    return angle;
  }

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw InputError::statement(file_, line_, problem, remedy);
  }

  const std::set<std::string> kWithoutEffect = {"G40", "G49", "G54", "G61", "G64",
                                                "G80", "G94", "G95", "G96", "G97"};

  const Model& model_;
  const Motion& motion_;
  const std::string& file_;
  Trajectory result_;
  std::array<std::size_t, 3> parameter_{};
  std::array<numeric, 3> to_model_;
  std::vector<ex> held_;
  std::set<std::string> ignored_;
  std::array<std::optional<numeric>, 3> position_;  ///< in mm
  numeric unit_ = 1;                                ///< in mm
  int mode_ = 0, plane_ = 0, line_ = 0;
  bool is_relative_ = false, has_absolute_centres_ = false, has_rapid_ = false, skips_ = false,
       ended_ = false;
};

}  // namespace

bool is_gcode_file(const std::string& file) {
  for (const char* ending : {".gcode", ".nc", ".ngc", ".tap", ".gc"})
    if (file.ends_with(ending)) return true;
  return false;
}

Trajectory read_gcode(const Model& model, const Motion& motion, const std::string& file) {
  return GcodeReader(model, motion, file).read();
}

}  // namespace regulus::model
