// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/motion_comparison.hpp"

#include <algorithm>
#include <map>

#include "runtime/verifier/branch_quantity.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/place_comparison.hpp"
#include "runtime/verifier/quantity_lines.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfMotion = 2048;
constexpr std::string_view kWithinRanges = "within-ranges", kReachable = "reachable";

class MotionComparison {
 public:
  MotionComparison(QuestionComparer& comparer, SectionReading* section,
                   const std::vector<std::string>& poses, const std::set<std::string>& compared)
      : comparer_(comparer),
        q_(comparer.question()),
        values_(comparer.values()),
        section_(section),
        poses_(poses),
        compared_(compared),
        motion_("motion." + q_.motion + '.') {}

  void run() {
    if (is_place_of_option()) return;
    require_motion();
    compare_threshold();
    for (const std::string& pose : poses_) compare_pose(pose);
    compare_parameters();
    require_known_names();
    compare_reach();
    compare_constraints();
    compare_conditions();
    require_known_keys();
  }

 private:
  [[nodiscard]] bool has(const std::string& place) const { return values_.contains(place); }
  [[nodiscard]] bool states(const std::string& key) const { return q_.stated.contains(key); }

  [[nodiscard]] bool has_table() const {
    const auto first = values_.lower_bound(motion_);
    return first != values_.end() && first->first.starts_with(motion_);
  }

  /// The values of all pose parameters at which solutions are asked for may come from options.
  bool is_place_of_option() {
    if (!q_.solutions || has_table() || !comparer_.may_differ(kPlaceOption)) return false;
    comparer_.note_difference("the file has no motion '" + q_.motion +
                              "'; the place is that of the certificate");
    for (const auto& [key, stated] : q_.stated)
      if (key.starts_with("pose ") || key.starts_with("alpha ")) comparer_.note_compared(key);
    compare_conditions();
    return true;
  }

  void require_motion() const {
    const bool is_of_section = section_ != nullptr && !poses_.empty() &&
                               !section_->place_in_motion(q_.motion, poses_.front()).empty();
    const bool is_key = q_.motion.find_first_of(".[") == std::string::npos;
    if (!is_key || (!has_table() && !is_of_section))
      comparer_.refuse_model("the file has no motion '" + q_.motion + "'");
  }

  /// Forces, bounds and solutions have no threshold. That of a closure is its bound.
  void compare_threshold() {
    if (has_threshold_of_branch(q_) || (!q_.load && !q_.quantity && !q_.solutions)) {
      comparer_.compare_or_zero(motion_ + "alpha", "alpha ", "alpha");
    } else {
      if (!is_zero_number(q_.graph, q_.alpha)) comparer_.refuse_stated("alpha ");
      comparer_.note_compared("alpha ");
    }
  }

  /// Returns the place of the range or the value of a pose parameter.
  [[nodiscard]] std::string place_of(const std::string& pose) const {
    if (has(motion_ + pose) || has(motion_ + pose + "[0]") || section_ == nullptr)
      return motion_ + pose;
    const std::string place = section_->place_in_motion(q_.motion, pose);
    return place.empty() ? motion_ + pose : place;
  }

  void compare_pose(const std::string& pose) {
    compare_error(pose);
    const std::string key = "pose " + pose, place = place_of(pose);
    if (!states(key))
      comparer_.refuse_model("the file has the pose parameter '" + pose +
                             "', for which the certificate has no line 'pose'");
    if (compared_.contains(key)) return comparer_.note_compared(key);
    const bool is_range = has(place + "[0]"), is_parameter = states("lower " + pose);
    if (!is_range && !has(place))
      comparer_.refuse_model("the motion has no range and no value of '" + pose + '\'');
    if (!is_range && !is_parameter) return compare_value(place, pose);
    if (!is_parameter && q_.solutions) return compare_range_with_value(place, key, pose);
    if (!is_parameter) comparer_.refuse(comparer_.place_of(place + "[0]"), "a value of " + pose);
    if (!is_own_parameter(pose)) comparer_.refuse_stated(key);
    comparer_.note_compared(key);
    compare_range(place, pose, is_range);
  }

  void compare_value(const std::string& place, const std::string& pose) {
    const NodeId value = comparer_.compare_at(place, "pose " + pose, q_.commanded);
    if (value != kNoNode) comparer_.definedness().require(place, value);
  }

  /// An option can free a value, too.
  void compare_range(const std::string& place, const std::string& name, bool is_range) {
    const std::string option = "range " + name;
    comparer_.compare_constant_at(is_range ? place + "[0]" : place, "lower " + name, option);
    comparer_.compare_constant_at(is_range ? place + "[1]" : place, "upper " + name, option);
    if (is_range && has(place + "[2]"))
      comparer_.leave_out(comparer_.place_of(place + "[2]"), "a range has two ends");
  }

  /// Solutions are those at one value, which an option may have chosen.
  void compare_range_with_value(const std::string& place, const std::string& stated,
                                const std::string& name) {
    for (const char* end : {"[0]", "[1]"})
      comparer_.compare_constant_at(place + end, stated, "range " + name);
  }

  /// True if the pose parameter is the parameter of its name.
  [[nodiscard]] bool is_own_parameter(const std::string& pose) const {
    const Node node = q_.graph.nodes()[std::size_t(q_.stated.at("pose " + pose).node)];
    return node.op == Op::kVariable && q_.variables[std::size_t(node.a)].name == pose;
  }

  /// Options cannot make an error smaller.
  void compare_error(const std::string& pose) {
    const std::string stated = "error " + pose, option = "tube " + pose;
    const std::size_t before = comparer_.differences();
    const NodeId error = comparer_.compare_or_zero(motion_ + "error." + pose, stated, option);
    if (comparer_.differences() == before) return;
    const auto found = q_.stated.find(stated);
    const NodeId now = found == q_.stated.end() ? q_.graph.number("0") : found->second.node;
    const auto growth =
        evaluate(q_.graph, {q_.graph.add(Op::kSubtract, now, error)}, {}, kBitsOfMotion);
    if (!growth || arb_is_positive((*growth)[0].get()) == 0)
      comparer_.refuse(comparer_.place_of(motion_ + "error." + pose), "a smaller one");
  }

  void compare_parameters() {
    const std::string table = motion_ + "parameters.";
    std::set<std::string> names;
    for (auto at = values_.lower_bound(table); at != values_.end() && at->first.starts_with(table);
         ++at) {
      const std::string rest = at->first.substr(table.size());
      names.insert(rest.substr(0, rest.find_first_of(".[")));
    }
    const bool is_along_waypoints = std::ranges::any_of(
        compared_, [](const std::string& key) { return key.starts_with("lower "); });
    for (const std::string& name : names) {
      if (is_along_waypoints) continue;  // They take its place.
      if (q_.solutions) {
        compare_value_of_parameter(table + name, name);
        continue;
      }
      if (!states("lower " + name))
        comparer_.refuse(comparer_.place_of(table + name + "[0]"), "no parameter " + name);
      compare_range(table + name, name, true);
    }
  }

  /// In a question about solutions a parameter is a constant.
  void compare_value_of_parameter(const std::string& place, const std::string& name) {
    if (states("value " + name)) return compare_range_with_value(place, "value " + name, name);
    comparer_.leave_out(comparer_.place_of(place + "[0]"),
                        "the certificate has no line 'constant " + name + "'");
  }

  /// The certificate has no parameter and no pose parameter of its own.
  void require_known_names() {
    for (const std::string& key : compared_)
      if (!key.starts_with("pose ")) comparer_.note_compared(key);  // Poses have been compared.
    for (const char* kind : {"lower ", "pose ", "error "})
      for (auto at = q_.stated.lower_bound(kind);
           at != q_.stated.end() && at->first.starts_with(kind); ++at)
        if (!comparer_.is_compared(at->first)) comparer_.refuse_stated(at->first);
  }

  /// Each line `reach` must be the operand of a root of the file's model. With fewer lines the claim
  /// is about more poses, at which the model must have a value all the same.
  void compare_reach() {
    const std::string place = motion_ + "where";
    const std::string word = has(place) ? values_.at(place).text : "";
    if (q_.is_within_reach && word.empty())
      comparer_.refuse_model("it leaves out the poses out of reach, but the motion has no 'where'");
    std::vector<NodeId> operands;
    for (auto at = q_.stated.lower_bound("reach ");
         at != q_.stated.end() && at->first.starts_with("reach "); ++at) {
      if (operands.empty()) operands = operands_of_roots();
      const NodeId claimed = at->second.node;
      reach_.push_back(claimed);
      comparer_.definedness().claim_nonnegative(claimed);
      if (std::any_of(operands.begin(), operands.end(),
                      [&](NodeId operand) { return certain_proportional(q_, operand, claimed); }))
        comparer_.note_compared(at->first);
    }
  }

  [[nodiscard]] std::vector<NodeId> operands_of_roots() {
    std::set<NodeId> roots;
    for (const NodeId expression : comparer_.model_expressions())
      for (const NodeId id : ingredients(q_.graph, {comparer_.without_errors(expression)}))
        if (const Node node = q_.graph.nodes()[std::size_t(id)]; node.op == Op::kSqrt)
          roots.insert(node.a);
    return {roots.begin(), roots.end()};
  }

  /// Within reach, √x is √|x|: the certificate may state either.
  [[nodiscard]] NodeId within_reach(NodeId constraint) {
    if (reach_.empty()) return constraint;
    Graph& graph = q_.graph;
    std::map<NodeId, NodeId> known;
    for (const NodeId id : ingredients(graph, {constraint})) {
      const Node node = graph.nodes()[std::size_t(id)];
      NodeId result = id;
      if (operands(node.op) == 2) result = graph.add(node.op, known.at(node.a), known.at(node.b));
      if (operands(node.op) == 1) {
        NodeId operand = known.at(node.a);
        if (node.op == Op::kSqrt && is_of_reach(node.a)) operand = graph.add(Op::kAbs, operand);
        result = graph.add(node.op, operand, node.b);
      }
      known.emplace(id, result);
    }
    return known.at(constraint);
  }

  [[nodiscard]] bool is_of_reach(NodeId operand) {
    return std::any_of(reach_.begin(), reach_.end(),
                       [&](NodeId known) { return certain_proportional(q_, known, operand); });
  }

  void compare_constraints() {
    std::size_t number = 0;
    for (; has(place_of_constraint(number)); ++number)
      if (const NodeId node = read_constraint(place_of_constraint(number)); node != kNoNode)
        compare_constraint(comparer_.place_of(place_of_constraint(number)), node, number);
      else
        comparer_.note_compared("constraint " + std::to_string(number));
    const std::string where = motion_ + "where";
    if (has(where) && values_.at(where).text == kWithinRanges && !compare_ranges(where, number))
      return comparer_.leave_out(comparer_.place_of(where),
                                 "this reader does not know the ranges of the joints");
    for (auto at = q_.stated.lower_bound("constraint ");
         at != q_.stated.end() && at->first.starts_with("constraint "); ++at)
      if (!comparer_.is_compared(at->first)) comparer_.refuse_stated(at->first);
  }

  [[nodiscard]] std::string place_of_constraint(std::size_t number) const {
    return motion_ + "constraints[" + std::to_string(number) + ']';
  }

  NodeId read_constraint(const std::string& place) {
    try {
      return comparer_.expression_at(place, q_.commanded);
    } catch (const Rejection& why) {
      comparer_.leave_out(comparer_.place_of(place), why.what());
    } catch (const Unfinished& why) {
      comparer_.leave_out(comparer_.place_of(place), why.what());
    }
    return kNoNode;
  }

  void compare_constraint(const FilePlace& from, NodeId node, std::size_t number) {
    const std::string stated = "constraint " + std::to_string(number);
    if (!states(stated)) comparer_.refuse(from, "no such constraint");
    comparer_.definedness().require(from.place, node);
    comparer_.compare(from, within_reach(node), stated);
  }

  bool compare_ranges(const std::string& where, std::size_t number) {
    const auto ranges = section_ == nullptr ? std::nullopt : section_->range_constraints(comparer_);
    if (!ranges) return false;
    for (const NodeId range : *ranges)
      compare_constraint(comparer_.place_of(where), range, number++);
    return true;
  }

  /// What the certificate says of values: its own expressions and lines have them.
  void compare_conditions() {
    Definedness& definedness = comparer_.definedness();
    for (const auto* list : {&q_.defined, &q_.motion_defined})
      for (const NodeId node : *list) definedness.claim(node);
    if (claims_entries())
      for (const NodeId entry : q_.matrix) definedness.claim(entry);
    if (q_.has_threshold)
      for (const NodeId scale : q_.scale) definedness.claim(scale);
    for (const char* kind : {"defined ", "motion-defined "})
      for (auto at = q_.stated.lower_bound(kind);
           at != q_.stated.end() && at->first.starts_with(kind); ++at) {
        comparer_.note_compared(at->first);
        definedness.expect_in_file("line " + std::to_string(at->second.line) + ", '" + kind +
                                       at->second.text.substr(0, 120) + "',",
                                   at->second.node);
      }
  }

  /// Some quantities use only a part of the matrix.
  [[nodiscard]] bool claims_entries() const {
    if (!q_.quantity) return true;
    const std::string& kind = q_.quantity->kind;
    return kind != format::kExpression && kind != format::kSpeed && kind != format::kSigmaMin &&
           kind != format::kSigmaMax;
  }

  void require_known_keys() {
    static const std::set<std::string, std::less<>> kKnown{
        "alpha", "constraints", "error", "interpolation", "parameters", "waypoints", "where"};
    for (auto at = values_.lower_bound(motion_);
         at != values_.end() && at->first.starts_with(motion_); ++at) {
      const std::string rest = at->first.substr(motion_.size());
      const std::string name = rest.substr(0, rest.find_first_of(".["));
      const bool is_pose = std::find(poses_.begin(), poses_.end(), name) != poses_.end();
      const bool is_word =
          name != "where" || at->second.text == kWithinRanges || at->second.text == kReachable;
      if ((!is_pose && !kKnown.contains(name)) || !is_word)
        comparer_.leave_out(comparer_.place_of(at->first), "this reader does not know it");
    }
  }

  QuestionComparer& comparer_;
  Question& q_;
  const WrittenValues& values_;
  SectionReading* section_;
  const std::vector<std::string>& poses_;
  const std::set<std::string>& compared_;
  const std::string motion_;   ///< "motion.NAME."
  std::vector<NodeId> reach_;  ///< of the lines `reach`
};

}  // namespace

void compare_motion(QuestionComparer& comparer, SectionReading* section,
                    const std::vector<std::string>& poses, const std::set<std::string>& compared) {
  MotionComparison(comparer, section, poses, compared).run();
}

}  // namespace regulus::verifier
