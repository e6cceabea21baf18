// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/joint_chain.hpp"

#include <algorithm>

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/section_values.hpp"

namespace regulus::verifier {
namespace {

constexpr std::string_view kJoints = "serial.joints[";

std::string joint_place(std::size_t index) {
  return std::string(kJoints) + std::to_string(index) + "].";
}

std::string text_at(const WrittenValues& values, const std::string& place,
                    const std::string& otherwise) {
  const auto found = values.find(place);
  return found == values.end() ? otherwise : found->second.text;
}

std::size_t count_joints(const WrittenValues& values) {
  std::size_t count = 0;
  for (auto at = values.lower_bound(kJoints); at != values.end() && at->first.starts_with(kJoints);
       ++at)
    count = std::max(count, std::size_t(std::atoi(at->first.c_str() + kJoints.size())) + 1);
  return count;
}

bool slides(const WrittenValues& values, const std::string& joint) {
  const std::string type = text_at(values, joint + "type", "revolute");
  if (type != "revolute" && type != "continuous" && type != "prismatic" && type != "fixed")
    throw Unfinished("the joint type '" + type + "' is not known");
  return type == "prismatic";
}

const SectionTolerance kLengths{"serial.length_tolerance", "tolerance lengths"};
const SectionTolerance kAngles{"serial.angle_tolerance", "tolerance angles", true};

/// Returns an expression that stands for a number of its own. No other expression has this node.
NodeId any_number(Graph& graph, std::size_t column) {
  constexpr long kUnusual = -1'000'003;
  return graph.add(Op::kExp, graph.number(Rational(kUnusual - long(column))));
}

class ChainReader {
 public:
  explicit ChainReader(SectionComparer& comparer)
      : q_(comparer.question()),
        values_(comparer.values()),
        algebra_(q_.graph),
        in_degrees_(is_arm_in_degrees(comparer.values())),
        section_(comparer, in_degrees_) {}

  ReadArm read(bool has_tool) {
    require_known_keys();
    const std::vector<ChainName> names = chain_names(values_);
    PlacementNodes since = algebra_.at_rest();
    const std::string convention = text_at(values_, "serial.convention", "origins");
    for (std::size_t i = 0; i < count_joints(values_); ++i) {
      joint_ = joint_place(i);
      number_ = std::to_string(i + 1);
      VectorNodes axis = {algebra_.number(0), algebra_.number(0), algebra_.number(1)};
      PlacementNodes before = algebra_.at_rest(), after = before;
      if (convention == "origins")
        read_origin(before, axis);
      else if (convention == "standard-dh")
        before = along(), after = across();
      else if (convention == "modified-dh")
        before = algebra_.product(across(), along());
      else
        throw Unfinished("the convention '" + convention + "' is not known");
      since = algebra_.product(since, before);
      if (text_at(values_, joint_ + "type", "") != "fixed") {
        chain_.push_back({slides(values_, joint_), since, axis});
        read_motion(chain_.back(), names);
        since = algebra_.at_rest();
      }
      since = algebra_.product(since, after);
    }
    if (has_tool) since = algebra_.product(since, read_tool());
    return {std::move(chain_), since};
  }

 private:
  [[nodiscard]] bool has(const std::string& key) const {
    const auto at = values_.lower_bound(joint_ + key);
    return at != values_.end() &&
           (at->first == joint_ + key || at->first.starts_with(joint_ + key + '['));
  }

  /// A key that this reader does not know could have a meaning.
  void require_known_keys() const {
    static const std::set<std::string, std::less<>> kOfJoints{
        "name",       "type",     "range", "mimic", "multiplier", "offset", "xyz",  "rpy",
        "quaternion", "rotation", "axis",  "a",     "alpha",      "d",      "theta"},
        kOfTable{"unit",      "convention", "joints", "tool", "length_tolerance", "angle_tolerance",
                 "angle_unit"};
    constexpr std::string_view kTable = "serial.";
    for (auto at = values_.lower_bound(kTable);
         at != values_.end() && at->first.starts_with(kTable); ++at) {
      const auto name_at = [&](std::size_t begin) {
        return at->first.substr(begin, at->first.find_first_of(".[", begin) - begin);
      };
      const std::size_t joint = at->first.find("].");
      const bool is_known =
          at->first.starts_with(kJoints)
              ? joint != std::string::npos && kOfJoints.contains(name_at(joint + 2))
              : kOfTable.contains(name_at(kTable.size()));
      if (!is_known)
        throw Unfinished("line " + std::to_string(at->second.line) + ": " + at->first +
                         " is not known");
    }
  }

  NodeId quantity(const std::string& place, const std::string& name,
                  const SectionTolerance& tolerance) {
    // Without a tolerance it is no constant of its own.
    if (!has_tolerances_ || !values_.contains(tolerance.key))
      return tolerance.is_angle ? section_.angle(place) : section_.constant(place);
    return section_.quantity(place, name + '_' + number_, tolerance);
  }

  NodeId quantity_or_zero(const std::string& key, const SectionTolerance& tolerance) {
    return has(key) ? quantity(joint_ + key, key, tolerance) : algebra_.number(0);
  }

  // Denavit and Hartenberg.

  PlacementNodes across() {
    const NodeId a = quantity_or_zero("a", kLengths), alpha = quantity_or_zero("alpha", kAngles);
    return {algebra_.turn(0, alpha), {a, algebra_.number(0), algebra_.number(0)}};
  }
  PlacementNodes along() {
    const NodeId d = quantity_or_zero("d", kLengths), theta = quantity_or_zero("theta", kAngles);
    return {algebra_.turn(2, theta), {algebra_.number(0), algebra_.number(0), d}};
  }

  // Origins.

  std::string element(const std::string& key, std::size_t i) const {
    return joint_ + key + '[' + std::to_string(i) + ']';
  }

  VectorNodes quantities(const std::string& key, const std::array<const char*, 3>& names,
                         const SectionTolerance& tolerance) {
    VectorNodes result{};
    for (std::size_t i = 0; i < 3; ++i) result[i] = quantity(element(key, i), names[i], tolerance);
    return result;
  }

  void read_origin(PlacementNodes& origin, VectorNodes& axis) {
    if (has("axis")) {
      for (std::size_t i = 0; i < 3; ++i) axis[i] = section_.constant(element("axis", i));
      axis = algebra_.unit(axis);
    }
    if (has("xyz")) origin.p = quantities("xyz", {"x", "y", "z"}, kLengths);
    if (has("rpy"))
      origin.R =
          algebra_.turn_of_roll_pitch_yaw(quantities("rpy", {"roll", "pitch", "yaw"}, kAngles));
    if (has("quaternion")) {
      std::array<NodeId, 4> q{};
      for (std::size_t i = 0; i < 4; ++i) q[i] = section_.constant(element("quaternion", i));
      origin.R = algebra_.turn_of_quaternion(q);
    }
    if (has("rotation")) origin.R = read_rotation();
  }

  PlacementNodes read_tool() {
    joint_ = "serial.tool.";
    has_tolerances_ = false;
    PlacementNodes tool = algebra_.at_rest();
    VectorNodes none{};
    if (has("axis")) throw Unfinished("a tool has no axis");
    read_origin(tool, none);
    return tool;
  }

  MatrixNodes read_rotation() {
    MatrixNodes R{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        R[i][j] = section_.constant(element("rotation", i) + '[' + std::to_string(j) + ']');
    const MatrixNodes product = algebra_.product(R, algebra_.transposed(R));
    bool is_rotation = is_equal(algebra_.dot(R[0], algebra_.cross(R[1], R[2])), 1);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        is_rotation = is_rotation && is_equal(product[i][j], i == j ? 1 : 0);
    if (!is_rotation) throw Unfinished(joint_ + "rotation is not shown to be a rotation");
    return R;
  }

  bool is_equal(NodeId node, long number) {
    return equality(q_, node, algebra_.number(number)) == Equality::kEqual;
  }

  // The variable.

  void read_motion(ChainJoint& joint, const std::vector<ChainName>& names) {
    const std::string name =
        text_at(values_, joint_ + "mimic", text_at(values_, joint_ + "name", ""));
    const auto leader = std::ranges::find(names, name, &ChainName::name);
    const auto pose = q_.actual.find(name);
    if (leader == names.end() || pose == q_.actual.end())
      throw Unfinished("the certificate has no pose parameter for " + joint_);
    joint.column = std::size_t(leader - names.begin());
    const NodeId multiplier =
        has("multiplier") ? section_.constant(joint_ + "multiplier") : algebra_.number(1);
    const auto value = [&](NodeId leading) { return value_of(joint, multiplier, leading); };
    joint.rate = algebra_.product(multiplier, units_of(joint, leader->slides));
    joint.follows = has("mimic");
    joint.value = value(pose->second);
    joint.offset = value(algebra_.number(0));
    joint.free_pose = depends_on_variables(q_.graph, pose->second)
                          ? pose->second
                          : any_number(q_.graph, joint.column);
    joint.free_value = value(joint.free_pose);
  }

  /// Returns multiplier·q + offset, which may be a number of degrees, as a length or an angle.
  NodeId value_of(const ChainJoint& joint, NodeId multiplier, NodeId leading) {
    NodeId value = algebra_.product(multiplier, leading);
    const std::string offset = joint_ + "offset";
    if (values_.contains(offset))
      value = algebra_.sum(
          value, joint.slides ? section_.constant(offset) : section_.number_of_angle(offset));
    return joint.slides ? value : section_.in_radians(value);
  }

  /// The speed of a joint is one of lengths or radians, as its leader's.
  NodeId units_of(const ChainJoint& joint, bool leader_slides) {
    const NodeId one = algebra_.number(1);
    if (!in_degrees_ || joint.slides == leader_slides) return one;
    return joint.slides ? algebra_.quotient(one, algebra_.degrees(one)) : algebra_.degrees(one);
  }

  Question& q_;
  const WrittenValues& values_;
  GraphAlgebra algebra_;
  const bool in_degrees_;
  SectionValues section_;
  std::string joint_, number_;  ///< its place, and its number from 1
  bool has_tolerances_ = true;
  std::vector<ChainJoint> chain_;
};

}  // namespace

bool depends_on_variables(const Graph& graph, NodeId node) {
  return std::ranges::any_of(ingredients(graph, {node}), [&](NodeId part) {
    return graph.nodes()[std::size_t(part)].op == Op::kVariable;
  });
}

bool is_arm_in_degrees(const WrittenValues& values) {
  const std::string unit = text_at(values, "serial.angle_unit", "rad");
  return unit != "rad";
}

FilePlace place_of_joint(const WrittenValues& values, const std::string& name) {
  FilePlace place{"the frame of " + name, 0, "another"};
  for (std::size_t i = 0; i < count_joints(values) && place.line == 0; ++i)
    if (const auto found = values.find(joint_place(i) + "name");
        found != values.end() && found->second.text == name)
      place.line = found->second.line;
  return place;
}

std::vector<ChainName> chain_names(const WrittenValues& values) {
  std::vector<ChainName> names;
  for (std::size_t i = 0; i < count_joints(values); ++i) {
    const std::string joint = joint_place(i);
    const auto name = values.find(joint + "name");
    if (name == values.end() || text_at(values, joint + "type", "") == "fixed") continue;
    const std::string range = joint + "range";
    names.push_back(
        {name->second.text, slides(values, joint), values.contains(range + "[0]") ? range : ""});
  }
  return names;
}

std::vector<ChainJoint> read_chain(SectionComparer& comparer) {
  return ChainReader(comparer).read(false).joints;
}

ReadArm read_arm(SectionComparer& comparer) { return ChainReader(comparer).read(true); }

}  // namespace regulus::verifier
