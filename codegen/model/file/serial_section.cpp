// SPDX-License-Identifier: GPL-3.0-or-later
// [serial]: an arm by its joints, with Denavit-Hartenberg parameters or with origins and axes.
#include <map>
#include <optional>

#include "codegen/model/constants.hpp"
#include "codegen/model/file/exact_orientation.hpp"
#include "codegen/model/file/quantities.hpp"
#include "codegen/model/file/sections.hpp"
#include "codegen/model/mechanism/rotation.hpp"
#include "codegen/model/mechanism/serial.hpp"
#include "codegen/model/mechanism/serial_drawing.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

/// The meaning of the keys that place a joint.
enum class Convention {
  kOrigins,     ///< xyz, rpy or another orientation, axis
  kStandardDh,  ///< a and alpha behind the joint, d and theta along it
  kModifiedDh,  ///< a and alpha before the joint
};

enum class JointType { kRevolute, kPrismatic, kFixed };

/// The quantities of one kind, with one tolerance.
struct Tolerance {
  ex value = 0;
  const char* group = "";
  TomlEntry given{};
  bool is_used = false;
};

Placement translation(const ex& x, const ex& y, const ex& z) {
  Placement result;
  result.p = {x, y, z};
  return result;
}

Placement turn_x(const ex& angle) { return {rotation_roll_pitch_yaw(angle, 0, 0), {0, 0, 0}}; }
Placement turn_z(const ex& angle) { return {rotation_roll_pitch_yaw(0, 0, angle), {0, 0, 0}}; }

class SerialReader {
 public:
  SerialReader(ModelReading& reading, const TomlEntry& entry)
      : reading_(reading), toml_(reading.toml), entry_(entry) {}

  void read() {
    static const std::array<std::string, 7> kKeys = {
        "unit", "angle_unit",       "convention",     "joints",
        "tool", "length_tolerance", "angle_tolerance"};
    (void)toml_.entries(entry_, kKeys);
    if (const TomlEntry unit = toml_.optional(entry_, "unit"); unit.node)
      robot_.unit = toml_.label(unit);
    if (const TomlEntry unit = toml_.optional(entry_, "angle_unit"); unit.node)
      in_degrees_ = choice(
          toml_, unit,
          std::array{std::pair{std::string("rad"), false}, std::pair{std::string("deg"), true}});
    robot_.angle_unit = angle_unit();
    read_convention();
    read_tolerances();
    const TomlEntry joints = toml_.required(entry_, "joints");
    for (const TomlEntry& joint : toml_.elements(joints, "a list of joints")) read_joint(joint);
    require_use(toml_, length_.given, length_.value, length_.is_used, "length of a joint");
    require_use(toml_, angle_.given, angle_.value, angle_.is_used, "angle of a joint");
    const TomlEntry tool = toml_.optional(entry_, "tool");
    robot_.tool = tool.node ? compose_as_written(pending_, read_tool(tool)) : pending_;
    find_leaders();
    require_joints(joints);
    make_model();
  }

 private:
  void read_convention() {
    const TomlEntry given = toml_.optional(entry_, "convention");
    if (given.node)
      convention_ =
          choice(toml_, given,
                 std::array{std::pair{std::string("origins"), Convention::kOrigins},
                            std::pair{std::string("standard-dh"), Convention::kStandardDh},
                            std::pair{std::string("modified-dh"), Convention::kModifiedDh}});
  }

  void read_tolerances() {
    length_ = tolerance("length_tolerance", "lengths", NumberUnit::kPlain);
    angle_ = tolerance("angle_tolerance", "angles", angles());
    warn_about_angle(reading_.model.warnings, {-angle_.value, angle_.value}, angle_unit(),
                     toml_.place(angle_.given));
    if (in_degrees_) angle_.value *= one_degree();
  }

  Tolerance tolerance(const char* key, const char* group, NumberUnit unit) {
    const TomlEntry given = toml_.optional(entry_, key);
    if (!given.node) return {};
    const ParsedExpression term = toml_.constant(given, unit);
    append(reading_.model.must_be_defined, term.must_be_defined);
    return {checked_nonnegative(term, toml_.place(given)), group, given};
  }

  NumberUnit angles() const { return in_degrees_ ? NumberUnit::kDegrees : NumberUnit::kPlain; }
  std::string angle_unit() const { return in_degrees_ ? "deg" : "rad"; }

  void read_joint(const TomlEntry& joint) {
    ++index_;
    const JointType type = read_type(joint);
    Placement before, after;
    Point axis = {0, 0, 1};
    if (convention_ == Convention::kOrigins)
      before = read_origin_joint(joint, axis);
    else
      read_dh(joint, before, after);
    pending_ = compose(pending_, before);
    if (type == JointType::kFixed) {
      for (const char* key : {"range", "mimic"})
        if (const TomlEntry given = toml_.optional(joint, key); given.node)
          toml_.reject(given, "a fixed joint has no " + std::string(key), "remove it");
    } else {
      robot_.joints.push_back(
          {"", type == JointType::kRevolute ? JointKind::kRevolute : JointKind::kPrismatic,
           pending_, axis});
      pending_ = {};
      if (const TomlEntry mimic = toml_.optional(joint, "mimic"); mimic.node)
        read_follower(joint, mimic);
      else
        read_leader(joint);
    }
    pending_ = compose(pending_, after);
  }

  void read_leader(const TomlEntry& joint) {
    const std::string name_key = "name";
    const TomlEntry name = toml_.required(joint, name_key);
    require_pose_name(toml_, name, toml_.name(name));
    places_.push_back(name);
    robot_.joints.back().name = toml_.name(name);
    for (const char* key : {"multiplier", "offset"})
      if (const TomlEntry given = toml_.optional(joint, key); given.node)
        toml_.reject(given, std::string(key) + " without mimic",
                     "write mimic = \"JOINT\", the joint that this one follows");
    read_range(joint);
  }

  /// The joint that it follows may come later.
  void read_follower(const TomlEntry& joint, const TomlEntry& mimic) {
    for (const char* key : {"name", "range"})
      if (const TomlEntry given = toml_.optional(joint, key); given.node)
        toml_.reject(given, "a joint that follows another has no " + std::string(key),
                     "remove it: its value is multiplier * q + offset");
    SerialJoint& follower = robot_.joints.back();
    follower.name = "a follower of " + toml_.name(mimic);
    follower.follows =
        Following{0, constant_or(joint, "multiplier", 1, NumberUnit::kPlain), read_offset(joint)};
    leaders_.emplace_back(robot_.joints.size() - 1, mimic);
  }

  /// Returns a length, or an angle in radians. It has no tolerance of its own.
  ex read_offset(const TomlEntry& joint) {
    const bool turns = robot_.joints.back().kind == JointKind::kRevolute;
    const TomlEntry given = toml_.optional(joint, "offset");
    const ex offset = constant_or(joint, "offset", 0, turns ? angles() : NumberUnit::kPlain);
    const Tolerance& tolerance = turns ? angle_ : length_;
    if (!offset.is_zero() && !tolerance.value.is_zero())
      toml_.reject(given, tolerance.given.path + " does not apply to " + given.path,
                   "write the offset as a part of the joint's place, or remove the tolerance");
    if (!turns) return offset;
    warn_about_angle(reading_.model.warnings, {offset, offset}, angle_unit(), toml_.place(given));
    return in_degrees_ ? offset * one_degree() : offset;
  }

  ex constant_or(const TomlEntry& table, const std::string& key, const ex& otherwise,
                 NumberUnit unit) {
    const TomlEntry given = toml_.optional(table, key);
    if (!given.node) return otherwise;
    const ParsedExpression term = toml_.constant(given, unit);
    append(reading_.model.must_be_defined, term.must_be_defined);
    return term.value;
  }

  void find_leaders() {
    for (const auto& [follower, mimic] : leaders_) {
      const auto leader = std::ranges::find(robot_.joints, toml_.name(mimic), &SerialJoint::name);
      if (leader == robot_.joints.end())
        toml_.reject(mimic, "no joint of the list has the name '" + toml_.name(mimic) + "'",
                     "name a joint that follows no other");
      Following& follows = *robot_.joints[follower].follows;
      follows.leader = static_cast<std::size_t>(leader - robot_.joints.begin());
      if (in_degrees_)
        follows.multiplier *= degrees_in(robot_.joints[follower]) / degrees_in(*leader);
    }
  }

  /// The angle that one unit of the joint's value is; 1 for a length.
  static ex degrees_in(const SerialJoint& joint) {
    return joint.kind == JointKind::kRevolute ? one_degree() : ex(1);
  }

  JointType read_type(const TomlEntry& joint) {
    static const std::vector<std::string> kOrigins = {"name",       "type",     "range", "mimic",
                                                      "multiplier", "offset",   "xyz",   "rpy",
                                                      "quaternion", "rotation", "axis"};
    static const std::vector<std::string> kDh = {"name",   "type", "range", "mimic", "multiplier",
                                                 "offset", "a",    "alpha", "d",     "theta"};
    (void)toml_.entries(joint, convention_ == Convention::kOrigins ? kOrigins : kDh);
    const TomlEntry type = toml_.optional(joint, "type");
    if (!type.node) return JointType::kRevolute;
    return choice(toml_, type,
                  std::array{std::pair{std::string("revolute"), JointType::kRevolute},
                             std::pair{std::string("continuous"), JointType::kRevolute},
                             std::pair{std::string("prismatic"), JointType::kPrismatic},
                             std::pair{std::string("fixed"), JointType::kFixed}});
  }

  void read_dh(const TomlEntry& joint, Placement& before, Placement& after) {
    const ex a = length(toml_.optional(joint, "a"), "a");
    const ex alpha = angle(toml_.optional(joint, "alpha"), "alpha");
    const ex d = length(toml_.optional(joint, "d"), "d");
    const ex theta = angle(toml_.optional(joint, "theta"), "theta");
    const Placement across = compose(turn_x(alpha), translation(a, 0, 0));
    const Placement along = compose(turn_z(theta), translation(0, 0, d));
    const bool modified = convention_ == Convention::kModifiedDh;
    before = modified ? compose(across, along) : along;
    after = modified ? Placement{} : across;
  }

  Placement read_origin_joint(const TomlEntry& joint, Point& axis) {
    if (const TomlEntry given = toml_.optional(joint, "axis"); given.node)
      axis = read_unit_vector(reading_, given);
    return read_origin(joint);
  }

  Placement read_origin(const TomlEntry& table) {
    Placement origin;
    if (const TomlEntry xyz = toml_.optional(table, "xyz"); xyz.node)
      origin.p = quantities(xyz, {"x", "y", "z"}, &SerialReader::length);
    const TomlEntry rpy = toml_.optional(table, "rpy");
    const TomlEntry quaternion = toml_.optional(table, "quaternion");
    const TomlEntry rotation = toml_.optional(table, "rotation");
    if ((rpy.node != nullptr) + (quaternion.node != nullptr) + (rotation.node != nullptr) > 1)
      toml_.reject(table, "more than one orientation in " + table.path,
                   "keep one of rpy, quaternion and rotation");
    if (rpy.node) {
      const Point turns = quantities(rpy, {"roll", "pitch", "yaw"}, &SerialReader::angle);
      origin.R = rotation_roll_pitch_yaw(turns[0], turns[1], turns[2]);
    }
    for (const TomlEntry& exact : {quaternion, rotation})
      if (exact.node && !angle_.value.is_zero())
        toml_.reject(exact, "angle_tolerance does not apply to " + exact.path,
                     "write the orientation as rpy, or remove angle_tolerance");
    if (quaternion.node) origin.R = read_quaternion(reading_, quaternion);
    if (rotation.node) origin.R = read_rotation(reading_, rotation);
    return origin;
  }

  Point quantities(const TomlEntry& list, const std::array<const char*, 3>& names,
                   ex (SerialReader::*one)(const TomlEntry&, const std::string&)) {
    const auto values = elements_of(toml_, list, 3);
    Point result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = (this->*one)(values[i], names[i]);
    return result;
  }

  // A length or an angle is 0 if it is not given.

  ex length(const TomlEntry& given, const std::string& name) {
    return given.node ? quantity(given, read_quantity(reading_, given), name, length_) : ex(0);
  }

  ex angle(const TomlEntry& given, const std::string& name) {
    return given.node ? quantity(given, read_angle(reading_, given, in_degrees_), name, angle_)
                      : ex(0);
  }

  /// With a tolerance it becomes a parameter.
  ex quantity(const TomlEntry& given, const ParsedExpression& term, const std::string& name,
              Tolerance& tolerance) {
    if (!tolerance.given.node) return term.value;
    tolerance.is_used = true;
    const std::string declared = name + "_" + std::to_string(index_);
    units_[declared] = &tolerance == &length_ ? robot_.unit : "rad";
    return declare_quantity(reading_, given, declared, term, {tolerance.value, tolerance.group})
        .value;
  }

  void read_range(const TomlEntry& joint) {
    const TomlEntry range = toml_.optional(joint, "range");
    if (!range.node) return;
    const auto ends = elements_of(toml_, range, 2);
    const bool turns = robot_.joints.back().kind == JointKind::kRevolute;
    const NumberUnit unit = turns ? angles() : NumberUnit::kPlain;
    const ParsedExpression lo = toml_.constant(ends[0], unit), hi = toml_.constant(ends[1], unit);
    append(limits_.must_be_defined, lo.must_be_defined);
    append(limits_.must_be_defined, hi.must_be_defined);
    ranges_.push_back(checked_range(lo, hi, toml_.place(range)));
    if (turns)
      warn_about_angle(reading_.model.warnings, ranges_.back(), angle_unit(), toml_.place(range),
                       true);
  }

  /// The tool does not change the rank; a mistake in it is a mistake in the file.
  Placement read_tool(const TomlEntry& tool) {
    static const std::array<std::string, 4> kKeys = {"xyz", "rpy", "quaternion", "rotation"};
    (void)toml_.entries(tool, kKeys);
    length_ = angle_ = {};
    return read_origin(tool);
  }

  void require_joints(const TomlEntry& joints) {
    const std::size_t count = robot_.joints.size();
    if (count == 0) toml_.refuse(joints, "no joint that moves", "at least one");
    if (count > kMostJoints)
      toml_.refuse(joints, std::to_string(count) + " joints that move",
                   "at most " + std::to_string(kMostJoints));
    if (places_.empty()) toml_.refuse(joints, "no joint that follows no other", "at least one");
    if (!ranges_.empty() && ranges_.size() != places_.size())
      toml_.reject(joints, "only some joints have a range",
                   "give a range to every joint, for a motion 'limits', or to none");
  }

  void make_model() {
    reading_.model = serial_model(std::move(reading_.model), robot_, &reading_.meter);
    Model& model = reading_.model;
    model.arm = std::make_shared<const Serial>(robot_);
    if (!units_.empty()) {
      Drawing drawing = *model.drawing;
      drawing.units = units_;
      model.drawing = std::make_shared<const Drawing>(std::move(drawing));
    }
    for (GeometryParameter& g : model.geometry)
      if (const auto at = units_.find(g.name); at != units_.end())
        g.takes_degrees = in_degrees_ && at->second == "rad";
    if (in_degrees_) set_angles_in_degrees(model);
    for (std::size_t j = 0; j < model.pose.size(); ++j) {
      const PoseParameter& p = model.pose[j];
      reading_.names.declare(
          p.name, is_in_degrees(p.unit) ? angle_in_degrees(p.symbol) : variable(p.symbol),
          toml_.place(places_[j]));
    }
    if (ranges_.empty()) return;
    limits_.name = "limits";
    for (std::size_t j = 0; j < model.pose.size(); ++j) {
      const PoseParameter& p = model.pose[j];
      limits_.parameters.push_back({p.symbol, p.name, p.unit, ranges_[j]});
      limits_.pose.emplace_back(p.symbol);
      limits_.error.emplace_back(0);
    }
    model.motions.push_back(std::move(limits_));
  }

  ModelReading& reading_;
  const TomlReader& toml_;
  const TomlEntry& entry_;
  Serial robot_;
  Convention convention_ = Convention::kOrigins;
  bool in_degrees_ = false;  ///< numbers of angles are
  Tolerance length_, angle_;
  std::map<std::string, std::string> units_;  ///< of the quantities that have a tolerance
  int index_ = 0;                             ///< of the joint, from 1, fixed ones included
  Placement pending_;                         ///< since the last joint that moves
  std::vector<TomlEntry> places_;             ///< of the names
  std::vector<std::pair<std::size_t, TomlEntry>> leaders_;  ///< by joint that follows one
  std::vector<Range> ranges_;
  Motion limits_;
};

}  // namespace

void read_serial(ModelReading& reading, const TomlEntry& serial) try {
  SerialReader(reading, serial).read();
} catch (const ParseRefusal& refusal) {
  reading.toml.refuse(serial, refusal.found, refusal.expected);
}

}  // namespace regulus::detail
