// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_geometry.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "runtime/formal/coq_expression.hpp"
#include "runtime/formal/coq_question.hpp"
#include "runtime/formal/coq_real.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/file_expressions.hpp"
#include "runtime/verifier/model/section_reading.hpp"
#include "runtime/verifier/model/section_values.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kLegs = 6, kLine = 90;
constexpr std::string_view kAxes = "xyz", kQuaternion = "quaternion";
constexpr std::array<const char*, 3> kCoordinates = {"first ", "second ", "third "};

std::string index(std::size_t i) { return '[' + std::to_string(i) + ']'; }

[[noreturn]] void refuse_model(const std::string& what) {
  throw Unfinished("there is no theorem about a model file with " + what + " yet");
}

std::string text_of(const std::vector<std::string>& parts, const char* between) {
  std::string text;
  for (const std::string& part : parts) {
    if (!text.empty()) text += between;
    text += part;
  }
  return text;
}

enum class RobotClaim { kRegular, kAbove, kSingular, kSmall };

RobotClaim claim_of(const Question& q) {
  if (q.is_piecewise) throw Unfinished("there is no theorem about way-points of a model file yet");
  if (q.load || q.quantity || q.closure || q.solutions)
    throw Unfinished(
        "the theorem about a model file is for the claims NO SINGULARITY and SINGULARITY");
  if (q.singular) return q.has_threshold ? RobotClaim::kSmall : RobotClaim::kSingular;
  return q.has_threshold ? RobotClaim::kAbove : RobotClaim::kRegular;
}

/// A quantity of the theorem: its identifier, a value in the set, and its value at the pose of a
/// certificate, which is empty if that does not have it.
struct Quantity {
  std::string name, witness, of_pose;
  bool is_point = false;
};

class GeometryWriter {
 public:
  GeometryWriter(const Question& question, const CoqModel& model)
      : q_(question),
        values_(model.values),
        may_differ_(model.may_differ),
        claim_(claim_of(question)),
        motion_("motion." + question.motion + '.'),
        degrees_(poses_in_degrees(model.values)),
        section_(read_section(model.values)),
        expressions_(own_, values_, degrees_, hidden_,
                     [](std::string_view, const Scope&) { return kNoNode; }) {
    for (std::size_t i = 0; i < q_.variables.size(); ++i)
      of_pose_[q_.variables[i].name] = "quantity v " + std::to_string(i);
  }

  std::string write() {
    require_gough();
    read_threshold();
    read_geometry();
    read_parameters();
    read_poses();
    read_anchors();
    read_constraints();
    require_all_read();
    return text();
  }

 private:
  // What the file may have.

  [[nodiscard]] bool has(const std::string& place) const { return values_.contains(place); }
  [[nodiscard]] bool has_below(const std::string& table) const {
    const auto first = values_.lower_bound(table);
    return first != values_.end() && first->first.starts_with(table);
  }
  [[nodiscard]] std::string word(const std::string& place, const char* otherwise) const {
    const auto found = values_.find(place);
    return found == values_.end() ? otherwise : found->second.text;
  }

  void require_gough() const {
    for (const char* table : {"legs.", "serial.", "matrix.", "pose.", "closure."})
      if (has_below(table))
        refuse_model("the table [" + std::string(table, 0, std::string_view(table).size() - 1) +
                     ']');
    if (!section_)
      throw Unfinished("there is a theorem about model files with the table [gough] alone");
    require_known_keys("gough.", {"orientation", "unit", "angle_unit", "base", "platform",
                                  "base_tolerance", "platform_tolerance", "tolerance_shape"});
    for (const char* side : {"gough.base", "gough.platform"})
      if (has_below(side + index(kLegs))) refuse_model("more than six legs");
    if (!has_below(motion_) || q_.motion.find_first_of(".[") != std::string::npos)
      throw Unfinished("the model file has no motion '" + q_.motion + '\'');
    std::set<std::string> known{"alpha", "constraints", "error", "parameters"};
    for (const SectionPose& pose : section_->pose()) known.insert(pose.name);
    require_known_keys(motion_, known);
  }

  void require_known_keys(const std::string& table, const std::set<std::string>& known) const {
    for (auto place = values_.lower_bound(table);
         place != values_.end() && place->first.starts_with(table); ++place) {
      const std::string rest = place->first.substr(table.size());
      const std::string key = rest.substr(0, rest.find_first_of(".["));
      if (!known.contains(key))
        refuse_model("the key '" + key + "' in [" + table.substr(0, table.size() - 1) + ']');
    }
  }

  /// What has not been read may change the set or the robot.
  void require_all_read() const {
    for (const std::string& table :
         {motion_, std::string("gough.base["), std::string("gough.platform[")})
      for (auto place = values_.lower_bound(table);
           place != values_.end() && place->first.starts_with(table); ++place)
        if (!read_.contains(place->first)) refuse_model("the key " + place->first);
  }

  /// A claim without a threshold says nothing about one.
  void read_threshold() {
    const std::string place = motion_ + "alpha";
    const std::string written = has(place) ? text_at(place) : "0";
    threshold_ = stated("alpha ").value_or(written);
    if (!q_.has_threshold && threshold_ != "0")
      throw Unfinished(
          "the motion of the model file has a threshold, and the certificate has none");
  }

  // Expressions of the file.

  /// The number or the expression at a place, with the names of the motion.
  [[nodiscard]] NodeId node_at(const std::string& place, bool in_degrees = false) {
    if (!has(place)) throw Unfinished("the model file has no " + place);
    read_.insert(place);
    return expressions_.at(place, scope_, in_degrees);
  }
  [[nodiscard]] std::string text_at(const std::string& place, bool in_degrees = false) {
    const NodeId node = node_at(place, in_degrees);
    const WrittenValue& written = values_.at(place);
    return written.is_string ? coq_real(own_.graph, node, names_)
                             : coq_written_number(written.text, own_.graph);
  }
  [[nodiscard]] std::string witness_of(NodeId node) const {
    return coq_real(own_.graph, node, witnesses_);
  }
  /// A constant of the certificate.
  [[nodiscard]] std::optional<std::string> stated(const std::string& key) {
    const auto found = q_.stated.find(key);
    if (!may_differ_ || found == q_.stated.end()) return std::nullopt;
    return coq_real(own_.graph, parse(found->second.text, {}, own_.graph), {});
  }

  // Quantities.

  /// What a variable of the certificate is at a pose that it names.
  [[nodiscard]] std::string of_pose(const std::string& variable) const {
    const auto found = of_pose_.find(variable);
    return found == of_pose_.end() ? "" : found->second;
  }

  /// A constant, of the certificate if options may have changed it.
  [[nodiscard]] NodeId end_at(const std::string& place, const std::string& stated_end,
                              bool in_degrees) {
    const auto found = q_.stated.find(stated_end);
    if (!may_differ_ || found == q_.stated.end()) return node_at(place, in_degrees);
    read_.insert(place);
    return parse(found->second.text, {}, own_.graph);
  }

  /// A variable in a range.
  NodeId ranged(const std::string& name, const std::string& place, const std::string& stated_name,
                bool in_degrees) {
    const NodeId lower = end_at(place + "[0]", "lower " + stated_name, in_degrees);
    const NodeId upper = end_at(place + "[1]", "upper " + stated_name, in_degrees);
    const auto text = [&](const std::string& stated_end, const std::string& end) {
      const auto changed = stated(stated_end);
      return changed ? *changed : text_at(end, in_degrees);
    };
    conditions_.push_back(text("lower " + stated_name, place + "[0]") + " <= " + name +
                          " <= " + text("upper " + stated_name, place + "[1]"));
    Graph& graph = own_.graph;
    const NodeId sum = graph.add(Op::kAdd, lower, upper);
    return variable(name, graph.add(Op::kDivide, sum, graph.number("2")), of_pose(stated_name));
  }

  /// Adds a quantity, and returns its node.
  NodeId variable(const std::string& name, NodeId middle, const std::string& of_pose) {
    const std::string witness = coq_real(own_.graph, middle, witnesses_);
    names_.push_back(name);
    middles_.push_back(middle);
    witnesses_.push_back(coq_argument(witness));
    poses_.push_back(coq_argument(of_pose));
    quantities_.push_back({name, witness, of_pose});
    return own_.graph.add(Op::kVariable, int(names_.size()) - 1);
  }

  void read_geometry() {
    constexpr std::string_view kTable = "geometry.";
    std::set<std::string> names;
    for (auto place = values_.lower_bound(kTable);
         place != values_.end() && place->first.starts_with(kTable); ++place) {
      const std::string rest = place->first.substr(kTable.size());
      names.insert(rest.substr(0, rest.find_first_of(".[")));
    }
    for (const std::string& name : names) read_constant(std::string(kTable) + name, name);
  }

  /// A number, or a list of coordinates: NAME_1, …
  void read_constant(const std::string& place, const std::string& name) {
    const std::string value = has_below(place + '.') ? place + ".value" : place;
    std::vector<std::pair<std::string, std::string>> coordinates;  // place and name
    if (has(value)) coordinates.emplace_back(value, name);
    for (std::size_t i = 0; has(value + index(i)); ++i)
      coordinates.emplace_back(value + index(i), name + '_' + std::to_string(i + 1));
    const bool is_ball = has(place + ".radius");
    const std::string key = place + (is_ball ? ".radius" : ".tolerance");
    const std::string tolerance = tolerance_at(key, coordinates.at(0).second);
    if (tolerance == "0") {
      for (const auto& [at, own] : coordinates) {
        scope_[own] = node_at(at);
        of_certificate_[own] = text_at(at);
      }
      return;
    }
    if (is_ball && coordinates.size() != kAxes.size()) refuse_model("a ball in the plane");
    read_uncertain(coordinates, coq_argument(tolerance), is_ball);
  }

  void read_uncertain(const std::vector<std::pair<std::string, std::string>>& coordinates,
                      const std::string& tolerance, bool is_ball) {
    are_legs_certain_ = false;
    std::vector<std::string> values, names;
    for (const auto& [at, own] : coordinates) {
      values.push_back(text_at(at));
      names.push_back(coq_identifier(own));
      if (!is_ball)
        conditions_.push_back("near " + tolerance + ' ' + coq_argument(values.back()) + ' ' +
                              names.back());
      of_certificate_[own] = names.back();
      scope_[own] = variable(names.back(), node_at(at), is_ball ? "" : of_pose(own));
    }
    if (is_ball)
      conditions_.push_back("in_ball " + tolerance + " (" + text_of(values, ", ") + ") (" +
                            text_of(names, ", ") + ')');
  }

  void read_parameters() {
    const std::string table = motion_ + "parameters.";
    std::set<std::string> names;
    for (auto place = values_.lower_bound(table);
         place != values_.end() && place->first.starts_with(table); ++place) {
      const std::string rest = place->first.substr(table.size());
      names.insert(rest.substr(0, rest.find('[')));
    }
    std::vector<std::pair<std::string, NodeId>> nodes;
    for (const std::string& name : names) {
      nodes.emplace_back(name, ranged(coq_identifier(name), table + name, name, false));
      of_certificate_[name] = coq_identifier(name);
    }
    for (const auto& [name, node] : nodes) scope_[name] = node;
  }

  /// Values may use the names of ranges.
  void read_poses() {
    const std::vector<SectionPose> poses = section_->pose();
    for (const SectionPose& pose : poses) read_range(pose.name);
    for (const SectionPose& pose : poses) read_value(pose.name);
  }

  void read_range(const std::string& name) {
    const std::string place = motion_ + name;
    const bool is_freed = may_differ_ && q_.stated.contains("lower " + name);
    if (!has(place + "[0]") && !is_freed) return;
    const bool in_degrees = degrees_.contains(name);
    read_.insert(place);  // An option may have freed a value.
    const std::string own = error_of(name, in_degrees).empty() ? name : name + "_commanded";
    commanded_[name] = of_certificate_[name] = own;
    scope_[name] = ranged(own, place, name, in_degrees);
  }

  void read_value(const std::string& name) {
    const bool in_degrees = degrees_.contains(name);
    if (!commanded_.contains(name)) {
      values_of_poses_[name] = node_at(motion_ + name, in_degrees);
      commanded_[name] = of_certificate_[name] = text_at(motion_ + name, in_degrees);
    }
    const std::string& commanded = commanded_[name];
    const std::string error = error_of(name, in_degrees);
    if (!error.empty()) {
      conditions_.push_back("near " + coq_argument(error) + ' ' + coq_argument(commanded) + ' ' +
                            name);
      const auto value = values_of_poses_.find(name);
      const NodeId node = value == values_of_poses_.end() ? scope_.at(name) : value->second;
      const std::string of_error = of_pose(name + " error");
      quantities_.push_back(
          {name, witness_of(node),
           of_error.empty() ? "" : coq_real(own_.graph, node, poses_) + " + " + of_error});
    }
    of_certificate_[name + " error"] = error.empty() ? "0" : name + " - " + coq_argument(commanded);
    const std::string actual = error.empty() ? commanded : name;
    pose_.push_back(in_degrees ? coq_argument(actual) + "*deg" : actual);
  }

  [[nodiscard]] std::string error_of(const std::string& name, bool in_degrees) {
    const std::string place = motion_ + "error." + name;
    read_.insert(place);
    if (const auto error = stated("error " + name)) return *error;
    return has(place) ? text_at(place, in_degrees) : "";
  }

  /// Returns the tolerance of a quantity of the certificate: the error of an expression has another
  /// name.
  [[nodiscard]] std::string tolerance_at(const std::string& key, const std::string& name) {
    if (has(key)) read_.insert(key);
    for (const std::string& own : {name, name + "_error"}) {
      if (const auto spread = stated("spread " + own)) return *spread;
      if (stated("value " + own)) return "0";
    }
    return has(key) ? text_at(key) : "0";
  }

  // Anchors.

  /// Returns the anchor: a point of the theorem if it has a tolerance, or its coordinates.
  std::string read_anchor(const std::string& side, char letter, std::size_t leg) {
    const SectionQuantity written = section_quantity(
        values_, "gough." + side + index(leg), {"gough." + side + "_tolerance", ""},
        word("gough.tolerance_shape", "box") == "ball");
    std::vector<std::string> coordinates, witnesses;
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
      coordinates.push_back(text_at(written.value + index(axis)));
      witnesses.push_back(witness_of(node_at(written.value + index(axis))));
    }
    const std::string middle = '(' + text_of(coordinates, ", ") + ')';
    const std::string name = letter + std::to_string(leg + 1);
    const std::string tolerance = tolerance_at(written.tolerance.key, name + "_x");
    const bool is_certain = tolerance == "0";
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
      const std::string own = name + '_' + kAxes[axis];
      const std::string actual = is_certain ? coordinates[axis] : kCoordinates[axis] + name;
      of_certificate_[own] = actual;
      of_certificate_[own + "_error"] =
          is_certain ? "0" : actual + " - " + coq_argument(coordinates[axis]);
    }
    if (is_certain) return middle;
    are_legs_certain_ = false;
    conditions_.push_back((written.is_ball ? "in_ball " : "in_cube ") + coq_argument(tolerance) +
                          ' ' + middle + ' ' + name);
    std::vector<std::string> at_pose;
    for (const char axis : kAxes) at_pose.push_back(of_pose(name + '_' + axis));
    const bool is_known = std::ranges::find(at_pose, "") == at_pose.end() && !written.is_ball;
    const std::string witness = '(' + text_of(witnesses, ", ") + ')';
    quantities_.push_back(
        {name, witness, is_known ? '(' + text_of(at_pose, ", ") + ')' : "", true});
    return name;
  }

  void read_anchors() {
    std::vector<std::string> base, platform;
    for (std::size_t leg = 0; leg < kLegs; ++leg) base.push_back(read_anchor("base", 'a', leg));
    for (std::size_t leg = 0; leg < kLegs; ++leg)
      platform.push_back(read_anchor("platform", 'b', leg));
    for (std::size_t leg = 0; leg < kLegs; ++leg)
      legs_.push_back({"", '(' + base[leg] + ", " + platform[leg] + ')'});
  }

  /// They are about the commanded pose.
  void read_constraints() {
    for (const auto& [name, node] : values_of_poses_) scope_[name] = node;
    for (std::size_t i = 0; has(motion_ + "constraints" + index(i)); ++i) {
      conditions_.push_back(text_at(motion_ + "constraints" + index(i)) + " <= 0");
      constraints_.push_back(node_at(motion_ + "constraints" + index(i)));
    }
  }

  // The text.

  [[nodiscard]] std::string names_of(bool are_points, const char* between) const {
    std::vector<std::string> names;
    for (const Quantity& quantity : quantities_)
      if (quantity.is_point == are_points) names.push_back(quantity.name);
    return text_of(names, between);
  }
  [[nodiscard]] bool has_points() const { return !names_of(true, " ").empty(); }

  /// Returns `(x y : R) (a1 : point)`.
  [[nodiscard]] std::string binders() const {
    std::vector<std::string> groups;
    if (const std::string names = names_of(false, " "); !names.empty())
      groups.push_back('(' + names + " : R)");
    if (has_points()) groups.push_back('(' + names_of(true, " ") + " : point)");
    return text_of(groups, " ");
  }

  /// Returns the set as an application to its quantities.
  [[nodiscard]] std::string set() const {
    std::string text = "the_set";
    for (const bool are_points : {false, true})
      if (const std::string names = names_of(are_points, " "); !names.empty()) text += ' ' + names;
    return text;
  }

  [[nodiscard]] std::string orientation() const {
    std::string word = orientation_word();
    for (std::size_t i = kAxes.size(); i < pose_.size(); ++i) word += ' ' + coq_argument(pose_[i]);
    return '(' + word + ')';
  }
  [[nodiscard]] std::string orientation_word() const {
    const std::string orientation = word("gough.orientation", "");
    if (orientation == "euler-zxz") return "euler_zxz";
    if (orientation == "roll-pitch-yaw") return "roll_pitch_yaw";
    if (orientation == kQuaternion && claim_ == RobotClaim::kRegular) return orientation;
    if (orientation == kQuaternion)
      throw Unfinished("there is no theorem about a determinant with a quaternion yet");
    refuse_model("the orientation '" + orientation + '\'');
  }
  /// The rows of the certificate are those of the robot, times the squared norm of a quaternion.
  [[nodiscard]] std::string factor() const {
    if (word("gough.orientation", "") != kQuaternion) return "1";
    std::string sum;
    for (std::size_t i = kAxes.size(); i < pose_.size(); ++i)
      sum += (sum.empty() ? "" : " + ") + coq_argument(pose_[i]) + "^2";
    return '(' + sum + ')';
  }
  [[nodiscard]] std::string position() const {
    std::vector<std::string> coordinates(pose_.begin(), pose_.begin() + kAxes.size());
    return '(' + text_of(coordinates, ", ") + ')';
  }

  /// The quantities of the certificate by those of the theorem.
  [[nodiscard]] std::string point_of_certificate() const {
    std::vector<std::string> values;
    for (const Variable& variable : q_.variables) {
      const auto value = of_certificate_.find(variable.name);
      if (value == of_certificate_.end())
        throw Unfinished("the model file does not have the quantity '" + variable.name +
                         "' of the certificate");
      values.push_back(value->second);
    }
    return values.empty() ? "no_quantities" : '[' + text_of(values, "; ") + ']';
  }

  [[nodiscard]] std::string text() const {
    return "\nFrom Regulus Require Import Geometry.\n\n" + legs_text() +
           "(** What the theorem is about: " + std::string(may_differ_ ? kOfOptions : kOfFile) +
           " *)\nDefinition the_set" + (quantities_.empty() ? "" : ' ' + binders()) +
           " : Prop :=\n  " + (conditions_.empty() ? "True" : text_of(conditions_, " /\\\n  ")) +
           ".\n\n" + robot_theorem() + point_theorem();
  }

  [[nodiscard]] std::string legs_text() const {
    if (!are_legs_certain_) return "";
    return "(** The legs of the model file, each with its anchors on the base and on the platform. "
           "*)\n"
           "Definition legs : list leg :=\n  " +
           coq_list(legs_, "   ") + ".\n\n";
  }

  [[nodiscard]] std::string matrix(const char* word) const {
    const std::string legs =
        !are_legs_certain_ ? "\n    " + coq_list(legs_, "     ") + "\n   " : " legs";
    return std::string(word) + legs + ' ' + position() + ' ' + orientation();
  }

  [[nodiscard]] std::string robot_theorem() const {
    return q_.singular ? singular_theorem() : regular_theorem();
  }
  [[nodiscard]] std::string size_of_determinant() const {
    return "Rabs (determinant 6 (" + matrix("inverse_jacobian") + "))";
  }

  [[nodiscard]] std::string regular_theorem() const {
    const bool is_above = claim_ == RobotClaim::kAbove;
    const std::string conclusion = is_above
                                       ? coq_argument(threshold_) + " < " + size_of_determinant()
                                       : "full_column_rank 6 6 (" + matrix("gough") + ')';
    return "Theorem the_robot :" + (quantities_.empty() ? "" : " forall " + binders() + ',') +
           "\n  " + set() + " ->\n  " + conclusion + ".\nProof.\n  intros" +
           set().substr(std::string_view("the_set").size()) + " S.\n  " +
           (is_above ? "by_threshold" : "by_geometry") + " the_claim\n    " +
           point_of_certificate() + (is_above ? "" : ' ' + factor()) + " S.\nQed.\n";
  }

  [[nodiscard]] std::string singular_theorem() const {
    const bool is_small = claim_ == RobotClaim::kSmall;
    const std::string conclusion = is_small
                                       ? size_of_determinant() + " <= " + coq_argument(threshold_)
                                       : "determinant 6 (" + matrix("gough") + ") = 0";
    return "Theorem the_robot :" + (quantities_.empty() ? "" : " exists " + binders() + ',') +
           "\n  " + set() + " /\\\n  " + conclusion + ".\nProof.\n  destruct (" +
           (is_small ? "small_of_claim the_question the_scales the_threshold"
                     : "singular_of_claim the_question") +
           " the_claim) as [v S].\n" + exists(&Quantity::of_pose) +
           (is_small ? "  by_small_determinant" : "  by_singularity") + " S.\nQed.\n";
  }

  /// Names a value of each quantity.
  [[nodiscard]] std::string exists(std::string Quantity::*value) const {
    std::vector<std::string> values;
    for (const bool are_points : {false, true})
      for (const Quantity& quantity : quantities_) {
        if (quantity.is_point != are_points) continue;
        if ((quantity.*value).empty())
          throw Unfinished("the certificate has no quantity '" + quantity.name + "' at its pose");
        values.push_back(coq_argument(quantity.*value));
      }
    if (values.empty()) return "";
    const std::string line = text_of(values, ", ");
    return "  exists " + (line.size() < kLine ? line : text_of(values, ",\n    ")) + ".\n";
  }

  /// The middle of the ranges may not satisfy the constraints.
  [[nodiscard]] std::string point_theorem() const {
    if (q_.singular) return "";
    if (!is_middle_in_set())
      return "\n(** No point of the set is known that is easy to write: the middle of the ranges "
             "does "
             "not satisfy\n    the constraints. *)\n";
    return "\nTheorem the_set_is_inhabited :" +
           (quantities_.empty() ? "" : " exists " + binders() + ',') + "\n  " + set() +
           ".\nProof.\n" + exists(&Quantity::witness) + "  by_point.\nQed.\n";
  }

  [[nodiscard]] bool is_middle_in_set() const {
    constexpr long kBits = 128;
    const auto middles = evaluate(own_.graph, middles_, {}, kBits);
    if (!middles) return false;
    const auto values = evaluate(own_.graph, constraints_, *middles, kBits);
    return values && std::ranges::all_of(*values, [](const Ball& value) {
             return arb_is_nonpositive(value.get()) != 0;
           });
  }

  static constexpr const char* kOfFile = "the ranges of the model file.";
  static constexpr const char* kOfOptions =
      "ranges, tolerances and errors are those of the certificate,\n    as options may have "
      "changed those of the model file.";

  const Question& q_;
  const WrittenValues& values_;
  const bool may_differ_;
  const RobotClaim claim_;
  const std::string motion_;  ///< "motion.NAME."
  const Names degrees_, hidden_;
  const std::unique_ptr<SectionReading> section_;
  Question own_;  ///< its graph has the expressions of the file
  FileExpressions expressions_;
  Scope scope_;  ///< constants, parameters, and poses with ranges
  std::map<std::string, NodeId> values_of_poses_;
  std::map<std::string, std::string> commanded_;  ///< by pose parameter
  /// By the name of a variable of the certificate.
  std::map<std::string, std::string> of_certificate_;
  std::map<std::string, std::string> of_pose_;  ///< the same, at a pose that it names
  /// By the number of a variable of the graph: its name, and values in Coq.
  std::vector<std::string> names_, witnesses_, poses_;
  std::vector<NodeId> middles_;  ///< of their ranges
  std::vector<Quantity> quantities_;
  std::vector<std::string> conditions_, pose_;
  std::vector<CoqItem> legs_;
  std::vector<NodeId> constraints_;
  std::set<std::string> read_;  ///< places of the file
  std::string threshold_;
  bool are_legs_certain_ = true;
};

}  // namespace

std::string coq_geometry(const Question& question, const CoqModel& model) {
  return GeometryWriter(question, model).write();
}

}  // namespace regulus::verifier
