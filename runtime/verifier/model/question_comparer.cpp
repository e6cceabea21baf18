// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/question_comparer.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/model_comparison.hpp"
#include "runtime/verifier/quantity_lines.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kLongestText = 120, kMostSentences = 3;
constexpr long kBitsOfLength = 4096;

std::string shortened(const std::string& text) {
  return text.size() <= kLongestText ? text : text.substr(0, kLongestText) + "…";
}

std::string at_line(std::size_t line) {
  return line == 0 ? "" : "line " + std::to_string(line) + ": ";
}

std::string named(const FilePlace& from) {
  return from.place + (from.line == 0 ? "" : ", line " + std::to_string(from.line));
}

/// Returns "'1/20' in line 12".
std::string quoted(const StatedValue& stated) {
  const std::string line = stated.line == 0 ? "" : " in line " + std::to_string(stated.line);
  return '\'' + shortened(stated.text) + '\'' + line;
}

std::string kind_of(const std::string& stated) { return stated.substr(0, stated.find(' ')); }

/// What is 0 if it is not stated.
bool may_be_absent(const std::string& stated) {
  const std::string kind = kind_of(stated);
  return kind == "spread" || kind == "error" || kind.starts_with("wrench");
}

Names degrees_of(const WrittenValues& values, const SectionReading* section) {
  if (section == nullptr) return poses_in_degrees(values);
  Names names;
  for (const SectionPose& pose : section->pose())
    if (pose.unit == "deg" || pose.unit == "°") names.insert(pose.name);
  return names;
}

}  // namespace

QuestionComparer::QuestionComparer(Question& question, const WrittenValues& values,
                                   SectionReading* section, Names hidden, CutSides* sides,
                                   const Options& options, Verification& result)
    : q_(question),
      values_(values),
      section_(section),
      sides_(sides),
      options_(options),
      result_(result),
      degrees_(degrees_of(values, section)),
      hidden_(std::move(hidden)),
      expressions_(question, values, degrees_, hidden_,
                   [this](std::string_view name, const Scope& scope) {
                     return section_ == nullptr ? kNoNode : section_->name(name, scope, *this);
                   }),
      definedness_(question) {}

FilePlace QuestionComparer::place_of(const std::string& place) const {
  const auto found = values_.find(place);
  if (found == values_.end()) return {place, 0, "0"};
  return {place, found->second.line, found->second.text};
}

/// True for the range, the value and the error of a pose parameter or an unknown in degrees, and for
/// the error and the speed of a motor of a closure whose pose parameter is.
bool QuestionComparer::is_number_of_degrees(const std::string& stated) const {
  const std::string kind = kind_of(stated), name = stated.substr(kind.size() + 1);
  if ((kind == "motor-error" || kind == "motor-speed") && q_.closure) {
    const auto motor = std::size_t(std::atoi(name.c_str()));
    return motor < q_.closure->poses.size() && degrees_.contains(q_.closure->poses[motor]);
  }
  return (kind == "lower" || kind == "upper" || kind == "pose" || kind == "error" ||
          kind == "start" || kind == "unknown" || kind == "unknown-radius") &&
         degrees_.contains(name);
}

NodeId QuestionComparer::compare_at(const std::string& place, const std::string& stated,
                                    const Scope& scope, const std::string& option) {
  if (!values_.contains(place)) return kNoNode;
  const FilePlace from = place_of(place);
  NodeId node = kNoNode;
  try {
    node = on_sides(expressions_.at(place, scope, is_number_of_degrees(stated)));
  } catch (const Rejection& why) {
    leave_out(from, why.what());
  } catch (const Unfinished& why) {
    leave_out(from, why.what());
  }
  if (node == kNoNode)
    used_.insert(stated);
  else
    compare(from, node, stated, option);
  return node;
}

NodeId QuestionComparer::compare_or_zero(const std::string& place, const std::string& stated,
                                         const std::string& option) {
  if (values_.contains(place)) return compare_constant_at(place, stated, option);
  const NodeId zero = q_.graph.number("0");
  compare(place_of(place), zero, stated, option);
  return zero;
}

StatedValue QuestionComparer::stated_or_zero(const FilePlace& from, const std::string& stated) {
  const auto found = q_.stated.find(stated);
  if (found != q_.stated.end()) return found->second;
  if (!may_be_absent(stated)) refuse(from, "no line '" + stated + "'");
  return {q_.graph.number("0"), 0, "0"};
}

void QuestionComparer::compare(const FilePlace& from, NodeId value, const std::string& stated,
                               const std::string& option) {
  used_.insert(stated);
  const std::string kind = kind_of(stated);
  const bool is_entry = kind == "entry" || kind == "equation";
  if (is_entry || kind == "scale") expressions_of_model_.push_back(value);
  if (is_entry || kind == "value") definedness_.require(named(from), value);
  const StatedValue found = stated_or_zero(from, stated);
  if (option.starts_with("tolerance ")) groups_[option].emplace_back(from, found);
  switch (equality(q_, value, found.node)) {
    case Equality::kDifferent:
      return differ(from, found, option);
    case Equality::kUnknown:
      return leave_out(from, "algebra does not decide if '" + shortened(from.text) + "' and '" +
                                 shortened(found.text) + "' in line " + std::to_string(found.line) +
                                 " of the certificate are equal");
    case Equality::kEqual:
      result_.numbers += from.line > 0;
  }
}

bool QuestionComparer::may_differ(const std::string& option) const {
  return !option.empty() && !options_.fixed.contains(option) &&
         (options_.all_overridden || options_.overridden.contains(option));
}

void QuestionComparer::differ(const FilePlace& from, const StatedValue& stated,
                              const std::string& option) {
  if (!may_differ(option)) {
    const std::string hint = option.empty() || options_.fixed.contains(option)
                                 ? ""
                                 : "; the option allow-options takes what options have changed";
    refuse(from, quoted(stated) + hint);
  }
  changed_.insert(option);
  // The coordinates of a point share the place of their tolerance.
  std::string difference = at_line(from.line) + from.place + " is '" + shortened(from.text) +
                           "', but the certificate has '" + shortened(stated.text) + '\'';
  if (std::ranges::find(result_.differences, difference) == result_.differences.end())
    result_.differences.push_back(std::move(difference));
}

/// An option sets all members of a group alike.
void QuestionComparer::require_equal_tolerances() {
  for (const std::string& option : changed_)
    for (const auto& [from, stated] : groups_[option])
      if (equality(q_, groups_[option].front().second.node, stated.node) != Equality::kEqual)
        refuse(from, quoted(stated) + ", and another value for others of the same group");
}

void QuestionComparer::refuse(const FilePlace& from, const std::string& stated) {
  refuse_model(at_line(from.line) + from.place + " is '" + shortened(from.text) +
               "', but the certificate has " + stated);
}

void QuestionComparer::refuse_stated(const std::string& stated) const {
  const StatedValue& value = q_.stated.at(stated);
  refuse_model("line " + std::to_string(value.line) + " states '" + kind_of(stated) + "' '" +
               shortened(value.text) + "', which the file does not have");
}

void QuestionComparer::refuse_model(const std::string& why) const {
  throw OtherModel("the certificate is not about " + options_.model_name + ": " + why);
}

void QuestionComparer::refuse_negative(const FilePlace& from, NodeId length) const {
  const auto value = evaluate(q_.graph, {length}, {}, kBitsOfLength);
  if (value && arb_is_negative((*value)[0].get()) != 0)
    refuse_model(at_line(from.line) + from.place + " is the negative length '" +
                 shortened(from.text) + '\'');
}

void QuestionComparer::expect_ball(const FilePlace& from, const std::vector<std::string>& names) {
  std::set<std::string> uncertain;
  for (const Variable& v : q_.variables)
    if (v.kind == VariableKind::kUncertain &&
        std::find(names.begin(), names.end(), v.name) != names.end())
      uncertain.insert(v.name);
  if (uncertain.empty()) return;  // The radius has been compared, and is 0.
  if (uncertain.size() != names.size()) refuse(from, "a ball of fewer coordinates, or a box");
  balls_.insert(std::move(uncertain));
}

void QuestionComparer::expect_defined(const FilePlace& from, NodeId value) {
  expressions_of_model_.push_back(value);
  definedness_.require(named(from), value);
}

void QuestionComparer::leave_out(const FilePlace& from, const std::string& why) {
  left_out_.push_back(named(from) + ": " + why);
}

NodeId QuestionComparer::without_errors(NodeId actual) {
  std::map<NodeId, NodeId> errors;
  Graph& graph = q_.graph;
  for (const NodeId id : ingredients(graph, {actual})) {
    const Node node = graph.nodes()[std::size_t(id)];
    if (node.op == Op::kVariable && q_.variables[std::size_t(node.a)].kind == VariableKind::kError)
      errors.emplace(id, graph.number("0"));
  }
  return replaced(graph, actual, std::move(errors));
}

/// A ball and a box of the same numbers are different sets.
void QuestionComparer::compare_balls() const {
  std::set<std::set<std::string>> stated;
  for (const BallOfVariables& ball : q_.balls) {
    std::set<std::string> names;
    for (const std::size_t member : ball.members) names.insert(q_.variables[member].name);
    stated.insert(std::move(names));
  }
  const auto only_in = [](const auto& one, const auto& other) -> std::string {
    for (const auto& ball : one)
      if (!other.contains(ball)) return *ball.begin();
    return "";
  };
  if (const std::string name = only_in(stated, balls_); !name.empty())
    refuse_model("the certificate has a line 'ball' with " + name +
                 ", for which the file declares a box or another ball");
  if (const std::string name = only_in(balls_, stated); !name.empty())
    refuse_model("the file declares a ball with " + name +
                 ", for which the certificate has no such line 'ball'");
}

void QuestionComparer::finish(bool has_balls) {
  require_equal_tolerances();
  if (has_balls) compare_balls();
  for (std::string& sentence : definedness_.missing()) left_out_.push_back(std::move(sentence));
  for (const auto& [key, stated] : q_.stated)
    if (!used_.contains(key) &&
        !(kind_of(key).starts_with("wrench") && is_zero_number(q_.graph, stated.node)))
      left_out_.push_back("line " + std::to_string(stated.line) + " states '" + kind_of(key) +
                          "' '" + shortened(stated.text) +
                          "', with which no value of the file was compared");
  if (left_out_.empty()) return;
  std::string text = "the certificate cannot be compared with " + options_.model_name;
  for (std::size_t k = 0; k < std::min(left_out_.size(), kMostSentences); ++k)
    text += (k == 0 ? ": " : "; ") + left_out_[k];
  if (left_out_.size() > kMostSentences)
    text += "; and " + std::to_string(left_out_.size() - kMostSentences) + " more";
  throw Unfinished(text);
}

}  // namespace regulus::verifier
