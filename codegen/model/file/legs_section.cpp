// SPDX-License-Identifier: GPL-3.0-or-later
// [legs]: a robot by its legs, [[legs.leg]], with points, axes and lengths.
#include <algorithm>
#include <array>
#include <map>

#include "codegen/model/constants.hpp"
#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/model/exact/exact_algebra.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/file/leg_geometry.hpp"
#include "codegen/model/file/sections.hpp"
#include "codegen/model/mechanism/extensible_legs.hpp"
#include "codegen/model/mechanism/legs_drawing.hpp"
#include "codegen/model/mechanism/orientation.hpp"
#include "codegen/model/names.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

constexpr std::size_t kMostLegs = 32;

/// The pose that the robot has, by the word of `orientation`.
enum class Pose { kAngles, kQuaternion, kFixed, kPoint };

std::string quoted(const char* word) { return std::string("\"").append(word).append("\""); }

class LegsReader {
 public:
  LegsReader(ModelReading& reading, const TomlEntry& entry)
      : reading_(reading), toml_(reading.toml), entry_(entry), geometry_(reading, entry) {}

  void read() {
    check_keys();
    geometry_.read_tolerances();
    const TomlEntry list = toml_.required(entry_, "leg");
    const auto legs = toml_.elements(list, "tables [[legs.leg]]");
    if (legs.empty() || legs.size() > kMostLegs)
      toml_.refuse(list, plural(legs.size(), "leg"), "1 to " + std::to_string(kMostLegs));
    for (const TomlEntry& leg : legs) read_type(leg);
    read_pose();
    for (std::size_t i = 0; i < legs.size(); ++i) read_leg(legs[i], i);
    geometry_.require_uses();
    make_model(legs);
  }

 private:
  static std::vector<std::string> keys_of_a_leg() {
    return {"type", "actuated", "base",  "platform", "crank", "rod",
            "axis", "bar",      "hinge", "zero",     "mode",  "range"};
  }

  void check_keys() {
    std::vector<std::string> known = keys_of_a_leg();
    for (const char* key : {"base", "platform"}) std::erase(known, key);
    for (const char* key : {"unit", "orientation", "angle_unit", "leg"}) known.emplace_back(key);
    for (std::string& key : LegGeometry::keys()) known.push_back(std::move(key));
    (void)toml_.entries(entry_, known);
  }

  // The pose.

  void read_type(const TomlEntry& leg) {
    (void)toml_.entries(leg, keys_of_a_leg());
    const TomlEntry given = required(leg, "type");
    std::vector<std::string> words;
    for (const LegType& type : leg_types()) words.push_back(quoted(type.name));
    const std::string word = toml_.text(given, alternatives(words));
    const auto types = leg_types();
    const auto type = std::ranges::find_if(types, [&](const LegType& t) { return t.name == word; });
    if (type == types.end()) toml_.refuse(given, alternatives(words));
    if (!robot_.legs.empty() && type->planar != robot_.legs.front().type->planar)
      toml_.reject(given,
                   std::string("a leg ") + type->name + " in " +
                       (type->planar ? "the plane" : "space") + " beside a leg " +
                       robot_.legs.front().type->name + " in " +
                       (type->planar ? "space" : "the plane"),
                   "use legs of one kind");
    robot_.legs.push_back({.type = &*type});
    robot_.planar = type->planar;
    axes_ = type->planar ? 2 : 3;
    geometry_.set_coordinates(axes_);
  }

  void read_pose() {
    if (const TomlEntry unit = toml_.optional(entry_, "unit"); unit.node) unit_ = toml_.label(unit);
    read_orientation();
    const TomlEntry given = toml_.optional(entry_, "angle_unit");
    if (given.node && pose_ != Pose::kAngles)
      toml_.reject(given, "the pose has no angles", "remove angle_unit");
    if (given.node)
      angle_unit_ = choice(toml_, given,
                           std::array{std::pair{std::string("rad"), std::string("rad")},
                                      std::pair{std::string("deg"), std::string("deg")}});
    for (std::size_t i = 0; i < axes_; ++i) declare_pose(kCoordinates[i], unit_);
    if (pose_ == Pose::kAngles || pose_ == Pose::kQuaternion)
      for (const std::string& name : angles())
        declare_pose(name, pose_ == Pose::kAngles ? angle_unit_ : "1");
    robot_.point = pose_ == Pose::kPoint;
    if (!robot_.point) set_rotation();
  }

  void read_orientation() {
    const TomlEntry given = toml_.optional(entry_, "orientation");
    if (robot_.planar) {
      if (given.node)
        pose_ = choice(toml_, given,
                       std::array{std::pair{std::string("angle"), Pose::kAngles},
                                  std::pair{std::string("point"), Pose::kPoint}});
      return;
    }
    using Choice = std::pair<Pose, Orientation>;
    const auto [pose, orientation] = choice(
        toml_, toml_.required(entry_, "orientation"),
        std::array{
            std::pair{std::string("euler-zxz"), Choice{Pose::kAngles, Orientation::kEulerZxz}},
            std::pair{std::string("roll-pitch-yaw"),
                      Choice{Pose::kAngles, Orientation::kRollPitchYaw}},
            std::pair{std::string("quaternion"),
                      Choice{Pose::kQuaternion, Orientation::kQuaternion}},
            std::pair{std::string("fixed"), Choice{Pose::kFixed, Orientation::kEulerZxz}},
            std::pair{std::string("point"), Choice{Pose::kPoint, Orientation::kEulerZxz}}});
    pose_ = pose;
    orientation_ = orientation;
  }

  std::vector<std::string> angles() const {
    return robot_.planar ? std::vector<std::string>{"phi"} : orientation_names(orientation_);
  }

  void declare_pose(const std::string& name, const std::string& unit) {
    const GiNaC::realsymbol symbol(name);
    reading_.names.declare(name, is_in_degrees(unit) ? angle_in_degrees(symbol) : variable(symbol),
                           toml_.place(entry_));
    reading_.model.pose.push_back({symbol, name, unit});
  }

  /// Names the entries of R: r11 … r33.
  void set_rotation() {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) robot_.rotation[i][j] = Formula(i == j ? 1 : 0);
    if (pose_ == Pose::kFixed) return;
    if (robot_.planar) {
      const Formula phi = unplaced("phi");
      const std::array<std::array<Formula, 2>, 2> R = {
          {{cos(phi), -sin(phi)}, {sin(phi), cos(phi)}}};
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j) robot_.rotation[i][j] = name_entry(i, j, R[i][j]);
      return;
    }
    std::vector<ex> symbols;
    for (const std::string& name : angles()) symbols.emplace_back(GiNaC::realsymbol(name));
    const ScaledRotation R = scaled_rotation(orientation_, symbols);
    for (unsigned i = 0; i < 3; ++i)
      for (unsigned j = 0; j < 3; ++j)
        robot_.rotation[i][j] = name_entry(i, j, unplaced(R.S(i, j) / R.N));
  }

  Formula name_entry(std::size_t i, std::size_t j, const Formula& value) {
    const std::string name = std::string("r").append(std::to_string(10 * (i + 1) + j + 1));
    reading_.names.declare_expression(name, value.text(), toml_.place(entry_));
    return unplaced(name);
  }

  // The legs.

  void read_leg(const TomlEntry& entry, std::size_t index) {
    Leg& leg = robot_.legs[index];
    number_ = std::to_string(index + 1);
    check_keys_of(entry, leg);
    read_actuated(entry, leg);
    leg.base = geometry_.point(toml_.required(entry, "base"), LegGroup::kBase, number_);
    if (!robot_.point)
      leg.platform =
          geometry_.point(toml_.required(entry, "platform"), LegGroup::kPlatform, number_);
    if (leg.type->kind == LegKind::kCrank)
      leg.crank = geometry_.length(required(entry, "crank"), LegGroup::kCrank, number_);
    if (leg.type->kind != LegKind::kTelescopic)
      leg.rod = geometry_.length(required(entry, "rod"), LegGroup::kRod, number_);
    if (uses(leg, "axis")) leg.axis = geometry_.axis(required(entry, "axis"), number_);
    if (uses(leg, "bar")) leg.bar = geometry_.direction(required(entry, "bar"));
    if (uses(leg, "hinge")) read_hinge(entry, leg);
    if (leg.type->keeps_orientation && leg.type->kind == LegKind::kCrank)
      leg.bar = leg.axis.direction;
    if (uses(leg, "mode"))
      leg.mode =
          choice(toml_, required(entry, "mode"),
                 std::array{std::pair{std::string("+"), true}, std::pair{std::string("-"), false}});
    read_range(entry, leg);
  }

  void read_hinge(const TomlEntry& entry, Leg& leg) {
    const TomlEntry given = required(entry, "hinge");
    const LegAxis hinge = geometry_.hinge(given, number_);
    leg.hinge = hinge.direction;
    if (leg.type->kind != LegKind::kSlider || !hinge.across || !leg.axis.across) return;
    const FormulaPoint &h = hinge.direction, &u = leg.axis.direction;
    if (!reduced(parsed(h[0] * u[0] + h[1] * u[1] + h[2] * u[2]).value).is_zero())
      toml_.reject(given, "the hinge of a leg PRS that is not shown to be across its rail",
                   "a leg moves in a plane with its rail: correct hinge or axis");
    leg.hinge_is_across = true;
  }

  /// True if a leg of its type has the key.
  bool uses(const Leg& leg, std::string_view key) const {
    const LegType& type = *leg.type;
    const bool crank = type.kind == LegKind::kCrank, slider = type.kind == LegKind::kSlider;
    if (key == "platform") return !robot_.point;
    if (key == "crank") return crank;
    if (key == "rod" || key == "mode") return crank || slider;
    if (key == "axis") return slider || (!type.planar && (crank || type.keeps_orientation));
    if (key == "bar") return slider && type.keeps_orientation;
    if (key == "hinge") return type.is_hinged;
    if (key == "zero") return crank && !type.planar;
    return true;
  }

  /// Refuses a key that has no meaning for this leg, unless it stands in [legs] for other legs.
  void check_keys_of(const TomlEntry& entry, const Leg& leg) const {
    for (const TomlEntry& given : toml_.entries(entry))
      if (!uses(leg, given.key))
        toml_.reject(given,
                     given.key == "platform"
                         ? std::string("the legs end in one point, the pose")
                         : std::string("a leg ") + leg.type->name + " has no " + given.key,
                     "remove it");
    if (!leg.type->keeps_orientation || pose_ == Pose::kFixed) return;
    toml_.reject(entry,
                 std::string("a leg ") + leg.type->name +
                     " keeps the platform from turning, so that it cannot be in every pose of this "
                     "orientation",
                 "write orientation = \"fixed\"");
  }

  void read_actuated(const TomlEntry& entry, Leg& leg) {
    leg.actuated = leg.type->kind == LegKind::kTelescopic ? 2 : 1;
    const TomlEntry given = optional(entry, "actuated");
    if (!given.node) return;
    const std::string nominal = std::to_string(leg.actuated);
    const std::string expected = leg.type->planar
                                     ? "the number of a joint, 1, 2 or 3 from the base, or \"none\""
                                     : nominal + ", the number of the joint that a leg " +
                                           leg.type->name + " can drive here, or \"none\"";
    if (const auto* text = given.node->as_string(); text && text->get() == "none") {
      leg.actuated = 0;
      return;
    }
    const auto* number = given.node->as_integer();
    if (!number ||
        (leg.type->planar ? number->get() < 1 || number->get() > 3 : number->get() != leg.actuated))
      toml_.refuse(given, expected);
    if (robot_.point && number->get() == 3)
      toml_.reject(given, "joint 3 turns against the platform, which is a point here",
                   "drive joint 1 or 2");
    leg.actuated = static_cast<int>(number->get());
  }

  void read_range(const TomlEntry& entry, Leg& leg) {
    const TomlEntry given = optional(entry, "range");
    if (!given.node || leg.actuated == 0) return;
    const auto ends = geometry_.elements(given, 2);
    const bool in_degrees = is_angle(leg) && is_in_degrees(angle_unit_);
    const NumberUnit unit = in_degrees ? NumberUnit::kDegrees : NumberUnit::kPlain;
    const ParsedExpression lo = geometry_.constant(ends[0], unit),
                           hi = geometry_.constant(ends[1], unit);
    Range range = checked_range(lo, hi, toml_.place(given));
    if (is_angle(leg)) {
      warn_about_angle(reading_.model.warnings, range, angle_unit_, toml_.place(given));
      if (in_degrees) range = {range.lo * one_degree(), range.hi * one_degree()};
      const CertainSign sign = certain_sign(range.hi - range.lo - 2 * GiNaC::Pi);
      if (sign != CertainSign::kNegative)
        toml_.reject(given, "the range of an angle is not shown to be less than a turn",
                     "a joint without stops needs no range");
      if (uses(leg, "zero")) leg.zero = geometry_.direction(required(entry, "zero"));
    } else if (leg.type->kind == LegKind::kTelescopic) {
      (void)checked_nonnegative(lo, toml_.place(ends[0]));
    }
    leg.range = JointRange{unplaced(range.lo), unplaced(range.hi)};
  }

  static bool is_angle(const Leg& leg) {
    return leg.type->kind == LegKind::kSlider
               ? leg.actuated != 1
               : leg.type->kind != LegKind::kTelescopic || leg.actuated != 2;
  }

  /// An entry of the leg, or of all legs.
  TomlEntry optional(const TomlEntry& leg, const std::string& key) const {
    const TomlEntry given = toml_.optional(leg, key);
    return given.node ? given : toml_.optional(entry_, key);
  }

  TomlEntry required(const TomlEntry& leg, const std::string& key) const {
    const TomlEntry given = optional(leg, key);
    return given.node ? given : toml_.required(leg, key);
  }

  void make_model(const std::vector<TomlEntry>& legs) {
    const WrittenLegs written = write_legs(robot_);
    for (const auto& [name, formula] : written.let)
      reading_.names.declare_expression(name, formula.text(), toml_.place(entry_));
    set_twist();
    set_rows(written.rows);
    const auto value = [this](const Formula& f) { return parsed(f).value; };
    if (pose_ != Pose::kFixed) reading_.model.legs = extensible_legs(robot_, value);
    for (const Formula& range : written.ranges) reading_.joint_ranges.push_back(parsed(range));
    reading_.model.drawing =
        std::make_shared<Drawing>(geometry_.labelled(legs_drawing(written.points, value), unit_));
    describe(legs.size(), written.rows);
  }

  ParsedExpression parsed(const Formula& formula) {
    const ParsedExpression term =
        parse_expression(formula.text(), reading_.names, toml_.place(entry_));
    reading_.count(term, entry_);
    return term;
  }

  ex of_the_matrix(const Formula& formula) {
    const ParsedExpression term = parsed(formula);
    append(reading_.model.must_be_defined, term.must_be_defined);
    return pose_ == Pose::kFixed && is_polynomial(term.value) ? reduced(term.value) : term.value;
  }

  /// At one orientation, polynomials are linear in the pose. Multiplied out, they show what cancels.
  bool is_polynomial(const ex& value) const {
    return std::ranges::all_of(symbols_of(value),
                               [&value](const ex& symbol) { return value.is_polynomial(symbol); });
  }

  void set_twist() {
    const auto all = twist_of_platform(unit_);
    for (std::size_t j = 0; j < 6; ++j)
      if (j < 3 ? j < axes_ : !robot_.point && (!robot_.planar || j == 5))
        reading_.model.twist.push_back(all[j]);
  }

  void set_rows(const std::vector<LegRow>& rows) {
    Model& model = reading_.model;
    const std::size_t columns = model.twist.size();
    if (rows.size() < columns)
      toml_.reject(entry_,
                   "the legs have " + plural(rows.size(), "motor and constraint") +
                       ", fewer than the " + plural(columns, "freedom") + " of the platform",
                   "add legs, or drive more of their joints");
    model.matrix =
        GiNaC::matrix(static_cast<unsigned>(rows.size()), static_cast<unsigned>(columns));
    for (unsigned i = 0; i < rows.size(); ++i) {
      for (unsigned j = 0; j < columns; ++j) model.matrix(i, j) = of_the_matrix(rows[i].entries[j]);
      model.row_scale.push_back(of_the_matrix(rows[i].scale));
    }
    model.motors.emplace();
    for (const LegRow& row : rows)
      if (row.motor)
        model.motors->push_back({row.leg + 1, is_angle(robot_.legs[row.leg]) ? "rad" : unit_});
  }

  void describe(std::size_t legs, const std::vector<LegRow>& rows) {
    std::map<std::string, std::size_t> counts;
    for (const Leg& leg : robot_.legs) ++counts[leg.type->name];
    std::vector<std::string> types;
    for (const auto& [name, count] : counts) types.push_back(std::to_string(count) + " " + name);
    const auto motors = std::size_t(std::ranges::count(rows, true, &LegRow::motor));
    std::string note =
        plural(legs, "leg") + ": " + enumeration(types) + "; rows of " + plural(motors, "motor");
    if (motors < rows.size()) note += " and " + plural(rows.size() - motors, "constraint");
    reading_.model.matrix_notes.push_back(std::move(note));
    if (robot_.planar) reading_.model.matrix_notes.emplace_back("motions in the plane only");
    if (robot_.point)
      reading_.model.matrix_notes.emplace_back(
          "the platform is a point: its orientation is not part of the question");
    if (pose_ == Pose::kFixed)
      reading_.model.matrix_notes.emplace_back(
          "the platform has one orientation; all six columns stand for what the legs must prevent");
  }

  ModelReading& reading_;
  const TomlReader& toml_;
  const TomlEntry& entry_;
  LegGeometry geometry_;
  std::string unit_ = "1", angle_unit_ = "rad";
  Pose pose_ = Pose::kAngles;
  Orientation orientation_ = Orientation::kEulerZxz;
  std::size_t axes_ = 3;
  std::string number_;  ///< of the leg
  Legs robot_;
};

}  // namespace

void read_legs(ModelReading& reading, const TomlEntry& legs) try {
  LegsReader(reading, legs).read();
} catch (const ParseRefusal& refusal) {
  reading.toml.refuse(legs, refusal.found, refusal.expected);
}

}  // namespace regulus::detail
