// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/way/gcode_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "codegen/model/exact/decimal.hpp"
#include "codegen/model/file/read_file.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/units.hpp"
#include "codegen/model/way/gcode_block.hpp"
#include "codegen/model/way/waypoint_file.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/files/sha256.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

/// The mode before the first word G0 to G3, and after G80.
constexpr int kNoMotion = -1;

/// An arc turns by at least 1 over this, in radians, and misses a whole turn by as much: controllers
/// take ends that are nearer to each other for a whole turn.
constexpr int kFinestTurn = 1'000'000;

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
    GcodeText lines(file_, text);
    while (!ended_) {
      const std::optional<GcodeBlock> block = lines.next();
      if (!block) break;
      run(*block);
    }
    if (result_.pieces.empty())
      fail("the program has no move after x, y and z are known",
           "begin with a move to a whole position, such as G0 X0 Y0 Z50");
    if (has_rapid_)
      result_.notes.push_back("G0 is taken as a straight line; some controllers move otherwise");
    if (!names_unit_)
      result_.notes.push_back("the program has no G20 or G21: its lengths are taken as mm");
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

  /// RS274/NGC, "order of execution": dwell, plane, units, distance, motion, end.
  void run(const GcodeBlock& block) {
    line_ = block.line;
    ignored_.insert(block.without_effect.begin(), block.without_effect.end());
    if (const std::string word = block.mode(GcodeGroup::kPlane); !word.empty())
      plane_ = word == "G17" ? 0 : word == "G18" ? 1 : 2;
    if (const std::string word = block.mode(GcodeGroup::kUnits); !word.empty())
      unit_ = word == "G20" ? numeric(254, 10) : numeric(1), names_unit_ = true;
    if (const std::string word = block.mode(GcodeGroup::kDistance); !word.empty())
      is_relative_ = word == "G91";
    if (const std::string word = block.mode(GcodeGroup::kCentres); !word.empty())
      has_absolute_centres_ = word == "G90.1";
    if (const std::string word = block.mode(GcodeGroup::kMotion); !word.empty())
      mode_ = word == "G80" ? kNoMotion : word[1] - '0';
    move(block);
    const std::string stop = block.mode(GcodeGroup::kStop);
    ended_ = stop == "M2" || stop == "M30";
  }

  void move(const GcodeBlock& block) {
    const auto is_given = [&block](char letter) { return block.has(letter); };
    const bool has_axis = std::ranges::any_of(std::string_view("XYZ"), is_given);
    const bool has_centre = std::ranges::any_of(std::string_view("IJK"), is_given);
    const bool begins_arc = !block.mode(GcodeGroup::kMotion).empty() && mode_ >= 2;
    if (!has_axis && !has_centre && !begins_arc) return;
    if (mode_ == kNoMotion)
      fail("coordinates are given where no move is in force", "write G0, G1, G2 or G3 before them");
    if (has_centre && mode_ < 2) fail("a straight move has no centre", "delete I, J and K");
    const auto target = target_of(block);
    const bool is_first = !std::ranges::all_of(position_, [](const auto& p) { return bool(p); });
    if (is_first && mode_ >= 2)
      fail("an arc begins at an unknown position", "begin with a move such as G0 X0 Y0 Z50");
    if (!is_first) mode_ < 2 ? add_line(target) : add_arc(target, block);
    position_ = target;
  }

  [[nodiscard]] std::array<std::optional<numeric>, 3> target_of(const GcodeBlock& block) const {
    std::array<std::optional<numeric>, 3> target = position_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto word = block.numbers.find("XYZ"[axis]);
      if (word == block.numbers.end()) continue;
      const numeric value = word->second * unit_;
      if (is_relative_ && !position_[axis])
        fail("a relative move begins at an unknown position",
             "begin with G90 and a whole position");
      target[axis] = is_relative_ ? numeric(*position_[axis] + value) : value;
    }
    return target;
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

  /// Returns the coordinates of the centre in the plane of the axes a and b.
  [[nodiscard]] std::array<numeric, 2> centre_of(const GcodeBlock& block, std::size_t a,
                                                 std::size_t b, std::size_t c) const {
    const bool has_first = block.has("IJK"[a]), has_second = block.has("IJK"[b]);
    if (block.has("IJK"[c]))
      fail(std::string("the word ") + "IJK"[c] + " is given for an arc in another plane",
           "write the plane, G17, G18 or G19, before the arc");
    if (!has_first && !has_second)
      fail("the centre of the arc is not given", "write it with I, J or K");
    if (has_absolute_centres_ && !(has_first && has_second))
      fail("G90.1 needs both coordinates of the centre", "write both");
    std::array<numeric, 2> centre;
    for (const auto& [axis, k] : {std::pair(a, 0U), std::pair(b, 1U)}) {
      const auto word = block.numbers.find("IJK"[axis]);
      const numeric given = word == block.numbers.end() ? numeric(0) : word->second * unit_;
      centre[k] = has_absolute_centres_ ? given : numeric(*position_[axis] + given);
    }
    return centre;
  }

  void add_arc(const std::array<std::optional<numeric>, 3>& target, const GcodeBlock& block) {
    if (block.has('P'))
      fail("the word P on the line of an arc makes further turns, also beside G4",
           "write G4 on a line of its own");
    const auto [a, b, c] = axes();
    const auto [x, y] = centre_of(block, a, b, c);
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
    if (!(std::abs(first - last) <= std::max(0.01, 1e-3 * first)))
      fail("the ends of the arc are not equally far from its centre: " + std::to_string(first) +
               " mm and " + std::to_string(last) + " mm",
           "correct its centre; I, J and K are relative to the begin of the arc unless G90.1");
  }

  /// Returns the angle, exactly: clockwise (G2) it is negative. Equal ends are a whole turn.
  [[nodiscard]] ex turn_between(const Arm& from, const Arm& to) const {
    const numeric cross = from.x * to.y - from.y * to.x, dot = from.x * to.x + from.y * to.y;
    const bool is_clockwise = mode_ == 2;
    if (!cross.is_zero() && dot.is_positive() && GiNaC::abs(cross) * kFinestTurn < dot)
      fail("the ends of the arc are too near to each other to tell it from a whole turn",
           "write equal ends for a whole turn, or a straight move");
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
  int mode_ = kNoMotion, plane_ = 0, line_ = 0;
  bool is_relative_ = false, has_absolute_centres_ = false, has_rapid_ = false, names_unit_ = false,
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

}  // namespace regulus::detail
