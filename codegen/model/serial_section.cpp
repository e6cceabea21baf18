// SPDX-License-Identifier: GPL-3.0-or-later
// [serial]: an arm by its joints, with Denavit-Hartenberg parameters or with origins and axes.
#include <optional>

#include "codegen/model/constants.hpp"
#include "codegen/model/rotation.hpp"
#include "codegen/model/sections.hpp"
#include "codegen/model/serial.hpp"
#include "codegen/model/serial_drawing.hpp"

namespace regulus::inline model {
namespace {

using GiNaC::ex;

/// The meaning of the keys that place a joint.
enum class Convention {
  kOrigins,     ///< xyz, rpy or another orientation, axis
  kStandardDh,  ///< a and alpha behind the joint, d and theta along it
  kModifiedDh,  ///< a and alpha before the joint
};

enum class JointType { kRevolute, kPrismatic, kFixed };

/// A quantity with a tolerance of its own: the name of its parameter, its group.
struct Tolerance {
  ex value = 0;
  const char* group = "";
  bool given = false;
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
    static const std::array<std::string, 6> kKeys = {"unit", "convention",       "joints",
                                                     "tool", "length_tolerance", "angle_tolerance"};
    (void)toml_.entries(entry_, kKeys);
    if (const TomlEntry unit = toml_.optional(entry_, "unit"); unit.node)
      robot_.unit = toml_.label(unit);
    read_convention();
    length_ = tolerance("length_tolerance", "lengths");
    angle_ = tolerance("angle_tolerance", "angles");
    const TomlEntry joints = toml_.required(entry_, "joints");
    for (const TomlEntry& joint : toml_.elements(joints, "a list of joints")) read_joint(joint);
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

  Tolerance tolerance(const char* key, const char* group) {
    const TomlEntry given = toml_.optional(entry_, key);
    if (!given.node) return {};
    const ParsedExpression term = toml_.constant(given);
    append(reading_.model.must_be_defined, term.must_be_defined);
    return {checked_nonnegative(term, toml_.place(given)), group, true};
  }

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
        Following{0, constant_or(joint, "multiplier", 1), constant_or(joint, "offset", 0)};
    leaders_.emplace_back(robot_.joints.size() - 1, mimic);
  }

  ex constant_or(const TomlEntry& table, const std::string& key, const ex& otherwise) {
    const TomlEntry given = toml_.optional(table, key);
    if (!given.node) return otherwise;
    const ParsedExpression term = toml_.constant(given);
    append(reading_.model.must_be_defined, term.must_be_defined);
    return term.value;
  }

  void find_leaders() {
    for (const auto& [follower, mimic] : leaders_) {
      const auto leader = std::ranges::find(robot_.joints, toml_.name(mimic), &SerialJoint::name);
      if (leader == robot_.joints.end())
        toml_.reject(mimic, "no joint of the list has the name '" + toml_.name(mimic) + "'",
                     "name a joint that follows no other");
      robot_.joints[follower].follows->leader =
          static_cast<std::size_t>(leader - robot_.joints.begin());
    }
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
    const ex a = quantity(toml_.optional(joint, "a"), "a", length_);
    const ex alpha = quantity(toml_.optional(joint, "alpha"), "alpha", angle_);
    const ex d = quantity(toml_.optional(joint, "d"), "d", length_);
    const ex theta = quantity(toml_.optional(joint, "theta"), "theta", angle_);
    const Placement across = compose(turn_x(alpha), translation(a, 0, 0));
    const Placement along = compose(turn_z(theta), translation(0, 0, d));
    const bool modified = convention_ == Convention::kModifiedDh;
    before = modified ? compose(across, along) : along;
    after = modified ? Placement{} : across;
  }

  Placement read_origin_joint(const TomlEntry& joint, Point& axis) {
    if (const TomlEntry given = toml_.optional(joint, "axis"); given.node) axis = read_axis(given);
    return read_origin(joint);
  }

  Placement read_origin(const TomlEntry& table) {
    Placement origin;
    if (const TomlEntry xyz = toml_.optional(table, "xyz"); xyz.node)
      origin.p = quantities(xyz, {"x", "y", "z"}, length_);
    const TomlEntry rpy = toml_.optional(table, "rpy");
    const TomlEntry quaternion = toml_.optional(table, "quaternion");
    const TomlEntry rotation = toml_.optional(table, "rotation");
    if ((rpy.node != nullptr) + (quaternion.node != nullptr) + (rotation.node != nullptr) > 1)
      toml_.reject(table, "more than one orientation in " + table.path,
                   "keep one of rpy, quaternion and rotation");
    if (rpy.node) {
      const Point angles = quantities(rpy, {"roll", "pitch", "yaw"}, angle_);
      origin.R = rotation_roll_pitch_yaw(angles[0], angles[1], angles[2]);
    }
    if (quaternion.node) origin.R = read_quaternion(quaternion);
    if (rotation.node) origin.R = read_rotation(rotation);
    return origin;
  }

  std::vector<TomlEntry> elements(const TomlEntry& list, std::size_t count) {
    const std::string expected = std::to_string(count) + " numbers";
    auto found = toml_.elements(list, expected);
    if (found.size() != count)
      toml_.refuse(list, std::to_string(found.size()) + " numbers in " + list.path, expected);
    return found;
  }

  Point quantities(const TomlEntry& list, const std::array<const char*, 3>& names,
                   const Tolerance& tolerance) {
    const auto values = elements(list, 3);
    Point result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = quantity(values[i], names[i], tolerance);
    return result;
  }

  /// A length or an angle, 0 if it is not given. With a tolerance it becomes a parameter.
  ex quantity(const TomlEntry& given, const std::string& name, const Tolerance& tolerance) {
    if (!given.node) return 0;
    const ParsedExpression term = toml_.expression(given, reading_.names);
    reading_.count(term, given);
    append(reading_.model.must_be_defined, term.must_be_defined);
    if (!tolerance.given || !term.constant) return term.value;
    const std::string parameter = name + "_" + std::to_string(index_);
    const GiNaC::realsymbol symbol(parameter);
    reading_.names.declare(parameter, variable(symbol), toml_.place(given));
    reading_.model.geometry.push_back(
        {symbol, parameter, term.value, tolerance.value, tolerance.group});
    return symbol;
  }

  std::vector<ex> constants(const TomlEntry& list, std::size_t count) {
    std::vector<ex> result;
    for (const TomlEntry& given : elements(list, count)) {
      const ParsedExpression term = toml_.constant(given);
      append(reading_.model.must_be_defined, term.must_be_defined);
      result.push_back(term.value);
    }
    return result;
  }

  /// Returns the sum of the squares; refuses a vector that is not proved to differ from zero.
  ex squared_length(const TomlEntry& list, const std::vector<ex>& v) {
    ex square = 0;
    for (const ex& component : v) square += pow(component, 2);
    square = reduced(square);
    if (!is_certainly_nonzero(square))
      toml_.reject(list, list.path + " is zero, or cannot be told from zero",
                   "it must have a direction");
    return square;
  }

  Point read_axis(const TomlEntry& list) {
    const std::vector<ex> v = constants(list, 3);
    const ex length = GiNaC::sqrt(squared_length(list, v));
    return reduced(Point{v[0] / length, v[1] / length, v[2] / length});
  }

  GiNaC::matrix read_quaternion(const TomlEntry& list) {
    const std::vector<ex> q = constants(list, 4);
    const ex square = squared_length(list, q);
    GiNaC::matrix R = scaled_rotation_quaternion(q[0], q[1], q[2], q[3]);
    for (unsigned i = 0; i < 3; ++i)
      for (unsigned j = 0; j < 3; ++j) R(i, j) = reduced(reduced(R(i, j)) / square);
    return R;
  }

  GiNaC::matrix read_rotation(const TomlEntry& list) {
    const auto rows = toml_.elements(list, "3 rows of 3 numbers");
    if (rows.size() != 3)
      toml_.refuse(list, std::to_string(rows.size()) + " rows in " + list.path, "3 rows");
    GiNaC::matrix R(3, 3);
    for (unsigned i = 0; i < 3; ++i) {
      const std::vector<ex> row = constants(rows[i], 3);
      for (unsigned j = 0; j < 3; ++j) R(i, j) = row[j];
    }
    const GiNaC::matrix product = R.mul(R.transpose());
    bool rotation = is_certainly_zero(R.determinant() - 1);
    for (unsigned i = 0; i < 3; ++i)
      for (unsigned j = 0; j < 3; ++j)
        rotation = rotation && is_certainly_zero(product(i, j) - (i == j ? 1 : 0));
    if (!rotation)
      toml_.reject(list, list.path + " is not proved to be a rotation",
                   "its numbers must be exact; rpy and quaternion always give a rotation");
    return R;
  }

  void read_range(const TomlEntry& joint) {
    const TomlEntry range = toml_.optional(joint, "range");
    if (!range.node) return;
    const auto ends = elements(range, 2);
    const ParsedExpression lo = toml_.constant(ends[0]), hi = toml_.constant(ends[1]);
    append(limits_.must_be_defined, lo.must_be_defined);
    append(limits_.must_be_defined, hi.must_be_defined);
    ranges_.push_back(checked_range(lo, hi, toml_.place(range)));
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
    for (std::size_t j = 0; j < model.pose.size(); ++j)
      reading_.names.declare(model.pose[j].name, variable(model.pose[j].symbol),
                             toml_.place(places_[j]));
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
  Tolerance length_, angle_;
  int index_ = 0;                  ///< of the joint, from 1, fixed ones included
  Placement pending_;              ///< since the last joint that moves
  std::vector<TomlEntry> places_;  ///< of the names
  std::vector<std::pair<std::size_t, TomlEntry>> leaders_;  ///< by joint that follows one
  std::vector<Range> ranges_;
  Motion limits_;
};

}  // namespace

void read_serial(ModelReading& reading, const TomlEntry& serial) try {
  SerialReader(reading, serial).read();
} catch (const Refusal& refusal) {
  reading.toml.refuse(serial, refusal.found, refusal.expected);
}

}  // namespace regulus::model
