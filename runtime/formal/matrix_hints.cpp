// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/matrix_hints.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "runtime/formal/coq_expression.hpp"
#include "runtime/formal/coq_real.hpp"
#include "runtime/formal/rational_in.hpp"
#include "runtime/formal/unrelated.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/arm_comparison.hpp"

namespace regulus::verifier {
namespace {

constexpr long kHintBits = 512;
constexpr int kHintPoints = 3;

/// The values of all variables of the robot's graph at a point.
using Values = std::vector<Ball>;

/// A number and a word that equals it.
struct Match {
  NodeId node = kNoNode;
  std::string text;
};

class HintSearch {
 public:
  HintSearch(const Question& question, RobotOfModel& robot, const NamedMatrix& matrix)
      : q_(question), robot_(robot), matrix_(matrix), graph_(robot.own.graph) {
    values_of_names_.assign(robot.names.size(), kNoNode);
    for (std::size_t i = 0; i < robot.names.size(); ++i)
      if (is_quantity_of(matrix, i)) order_.push_back(i);
    for (const MatrixArgument& one : matrix.arguments)
      if (one.is_number)
        numbers_.emplace(one.variable, one.value);
      else
        keep_value(one.variable, one.value);
    for (const MatrixName& one : matrix.names) keep_value(one.variable, one.value, one.is_kept);
    for (int number = 0; number < kHintPoints; ++number) {
      points_.push_back(point(number));
      others_.push_back(beside(points_.back(), number));
    }
  }

  MatrixHints run(const std::vector<std::string>& lines) {
    name_variables();
    const std::set<std::string, std::less<>> needed = names_used(lines, q_.has_threshold);
    for (const std::string& line : lines) read(line, needed);
    return std::move(hints_);
  }

 private:
  // The names.

  [[nodiscard]] std::size_t number_of(NodeId variable) const {
    return std::size_t(graph_.nodes()[std::size_t(variable)].a);
  }
  void keep_value(NodeId variable, NodeId value, bool is_kept = false) {
    if (value == kNoNode) return;
    value = without_numbers(value);
    if (!is_kept && is_radical(value)) {
      numbers_.emplace(variable, value);
      return;
    }
    values_of_names_[number_of(variable)] = value;
    order_.push_back(number_of(variable));
  }
  /// True if the value is made of rational numbers and roots of natural numbers, as name_lets of Matrices.v
  /// sees it.
  [[nodiscard]] bool is_radical(NodeId value) const {
    return std::ranges::all_of(ingredients(graph_, {value}), [this](NodeId id) {
      const Node& node = graph_.nodes()[std::size_t(id)];
      if (node.op == Op::kSqrt) {
        const Node& a = graph_.nodes()[std::size_t(node.a)];
        return a.op == Op::kConstant && graph_.rational(a.a).is_integer();
      }
      return node.op == Op::kConstant || node.op == Op::kNegate || node.op == Op::kAdd ||
             node.op == Op::kSubtract || node.op == Op::kMultiply || node.op == Op::kDivide ||
             node.op == Op::kPower;
    });
  }
  /// Names of numbers have no part in a proof.
  [[nodiscard]] NodeId without_numbers(NodeId node) { return replaced(graph_, node, numbers_); }
  /// Not an argument with a value, and not a name of the matrix.
  [[nodiscard]] bool is_quantity_of(const NamedMatrix& matrix, std::size_t number) const {
    const auto is_this = [&](const auto& one) {
      return number_of(one.variable) == number && one.value != kNoNode;
    };
    return std::ranges::none_of(matrix.arguments, is_this) &&
           std::ranges::none_of(matrix.names, is_this);
  }

  [[nodiscard]] std::optional<std::size_t> number_of(const std::string& identifier) const {
    const auto found = std::ranges::find(robot_.names, identifier);
    if (found == robot_.names.end()) return std::nullopt;
    return std::size_t(found - robot_.names.begin());
  }
  NodeId variable(std::size_t number) { return graph_.add(Op::kVariable, int(number)); }
  NodeId named(const std::string& identifier) {
    const auto number = number_of(identifier);
    return number ? variable(*number) : kNoNode;
  }

  [[nodiscard]] std::string quantity_of(const std::string& variable) const {
    const auto found = robot_.of_certificate.find(variable);
    return found == robot_.of_certificate.end() ? "" : found->second;
  }
  static std::string pose_of(const std::string& variable) {
    return variable.substr(0, variable.find(' '));
  }
  [[nodiscard]] const CoqPose* pose(const std::string& name) const {
    const auto found = std::ranges::find(robot_.poses, name, &CoqPose::name);
    return found == robot_.poses.end() ? nullptr : &*found;
  }

  /// The values of the names at a pose of the certificate.
  [[nodiscard]] Values point(int number) {
    const std::vector<Ball> of_certificate = some_point(q_, number, kHintBits);
    Values values(robot_.names.size());
    for (std::size_t i = 0; i < q_.variables.size(); ++i)
      if (const auto own = number_of(quantity_of(q_.variables[i].name)))
        values[*own] = of_certificate[i];
    for (std::size_t i = 0; i < q_.variables.size(); ++i)
      if (q_.variables[i].kind == VariableKind::kError)
        keep_error(pose_of(q_.variables[i].name), of_certificate[i], values);
    for (const std::size_t i : order_)
      if (values_of_names_[i] != kNoNode)
        if (const auto value = evaluate(graph_, {values_of_names_[i]}, values, kHintBits))
          values[i] = value->front();
    return values;
  }

  /// An error has a name, or the pose that has it.
  void keep_error(const std::string& name, const Ball& error, Values& values) {
    if (const auto own = number_of(coq_identifier(name) + "'error")) {
      values[*own] = error;
      return;
    }
    const auto actual = number_of(coq_identifier(name));
    if (!actual || pose(name) == nullptr) return;
    const auto commanded = evaluate(graph_, {pose(name)->commanded}, values, kHintBits);
    if (commanded) arb_add(values[*actual].get(), commanded->front().get(), error.get(), kHintBits);
  }

  /// Other values, as if the names had none of their own.
  static Values beside(const Values& values, int number) {
    constexpr int kParts = 1 << 20, kStep = 37, kPeriod = 97;
    Values other = values;
    for (std::size_t i = 0; i < other.size(); ++i) {
      Ball factor;
      arb_set_si(factor.get(), kParts + (int(i) * kStep + number * 11) % kPeriod - kPeriod / 2);
      arb_div_si(factor.get(), factor.get(), kParts, kHintBits);
      arb_mul(other[i].get(), other[i].get(), factor.get(), kHintBits);
      arb_sub_ui(factor.get(), factor.get(), 1, kHintBits);
      arb_add(other[i].get(), other[i].get(), factor.get(), kHintBits);
      arb_get_mid_arb(other[i].get(), other[i].get());
    }
    return other;
  }

  // The question.

  void name_variables() {
    for (const Variable& v : q_.variables) {
      if (v.kind == VariableKind::kError) continue;
      const NodeId node = named(quantity_of(v.name));
      if (node == kNoNode) throw Unfinished("the model file does not have '" + v.name + "'");
      commanded_[v.name] = node;
      if (v.kind == VariableKind::kUncertain) actual_[v.name] = node;
    }
  }

  void read(const std::string& line, const std::set<std::string, std::less<>>& needed) {
    std::string_view rest = line;
    const std::string_view key = take_until(rest, " ");
    if (key == "constant") {
      const std::string name(take_until(rest, " = "));
      define(named_constant(name), parse(rest, {}, graph_), {&commanded_[name], &actual_[name]});
    } else if (key == "pose") {
      read_pose(rest);
    } else if (key == "let") {
      const std::string name(take_until(rest, " = "));
      const NodeId node = parse(rest, actual_, graph_);
      define(needed.contains(name) ? match(node) : Match{}, node, {&actual_[name]});
    } else if (key == "entry") {
      compare(rest, matrix_.entries, hints_.entries);
    } else if (key == "scale") {
      compare(rest, matrix_.scales, hints_.scales);
    }
  }

  void define(const Match& match, NodeId node, const std::vector<NodeId*>& names) {
    for (NodeId* name : names) *name = match.node == kNoNode ? node : match.node;
    DefinitionHint hint{match.text, {}};
    if (match.node != kNoNode) hint.without = texts_of(names_between(node, match.node));
    hints_.definitions.push_back(std::move(hint));
  }

  Match named_constant(const std::string& name) {
    const NodeId node = named(coq_identifier(name));
    if (node == kNoNode || numbers_.contains(node)) return {};
    return {node, coq_identifier(name)};
  }

  /// The order is that of coq_question.
  void read_pose(std::string_view rest) {
    const std::string name(take_until(rest, " = "));
    if (pose_scope_.empty()) pose_scope_ = commanded_;
    const NodeId node = parse(take_until(rest, " +- "), pose_scope_, graph_);
    const std::string identifier = coq_identifier(name);
    const bool has_error = pose(name) != nullptr && pose(name)->has_error;
    if (!commanded_.contains(name))
      define(has_error ? Match{} : named_constant(name), node, {&commanded_[name]});
    actual_[name] = commanded_[name];
    if (!has_error) return;
    NodeId error = named(identifier + "'error");
    if (error == kNoNode)
      error = graph_.add(Op::kSubtract, named(identifier), pose(name)->commanded);
    define(named_constant(name), graph_.add(Op::kAdd, commanded_[name], error), {&actual_[name]});
  }

  void compare(std::string_view text, const std::vector<NodeId>& of_file,
               std::vector<std::vector<std::string>>& names) {
    if (names.size() >= of_file.size()) return;
    const NodeId stated = parse(text, actual_, graph_);
    names.push_back(texts_of(names_between(stated, without_numbers(of_file[names.size()]))));
  }

  // Words.

  [[nodiscard]] std::optional<std::vector<Ball>> at_points(NodeId node) const {
    std::vector<Ball> result;
    for (const Values& values : points_) {
      auto value = evaluate(graph_, {node}, values, kHintBits);
      if (!value || arb_contains_zero(value->front().get()) != 0) return std::nullopt;
      result.push_back(std::move(value->front()));
    }
    return result;
  }

  [[nodiscard]] static std::optional<Rational> ratio(const std::vector<Ball>& of,
                                                     const std::vector<Ball>& to, bool is_inverse) {
    std::optional<Rational> result;
    for (std::size_t i = 0; i < of.size(); ++i) {
      Ball quotient;
      if (is_inverse)
        arb_mul(quotient.get(), of[i].get(), to[i].get(), kHintBits);
      else
        arb_div(quotient.get(), of[i].get(), to[i].get(), kHintBits);
      if (!result) result = rational_in(quotient);
      if (!result || result->bits() > kMostRatioBits ||
          arb_contains_fmpq(quotient.get(), result->get()) == 0)
        return std::nullopt;
    }
    return result;
  }

  /// A multiple of a name, or of its inverse.
  Match match(NodeId node) {
    const auto own = at_points(node);
    if (!own || ratio(*own, std::vector<Ball>(own->size(), one()), false)) return {};
    for (const bool is_inverse : {false, true})
      for (const std::size_t number : order_) {
        std::vector<Ball> other;
        for (const Values& values : points_) other.push_back(values[number]);
        if (std::ranges::any_of(other,
                                [](const Ball& x) { return arb_contains_zero(x.get()) != 0; }))
          continue;
        const auto factor = ratio(*own, other, is_inverse);
        if (!factor) continue;
        const Match found = multiple(*factor, number, is_inverse);
        const std::vector<std::size_t> names = names_between(node, found.node);
        if (!rests_on_numbers(names, number) &&
            are_equal(without(node, names), without(found.node, names)))
          return found;
      }
    return {};
  }

  /// True for roots, and cosines and sines of angles that Coq knows.
  [[nodiscard]] bool has_known_value(NodeId value) {
    std::map<NodeId, NodeId> known;
    for (const NodeId id : ingredients(graph_, {value})) {
      const Node function = graph_.nodes()[std::size_t(id)];
      if ((function.op == Op::kCos || function.op == Op::kSin) &&
          is_known_angle(graph_, function.a))
        known[id] = graph_.number("1");
    }
    return is_radical(replaced(graph_, value, std::move(known)));
  }
  /// Constants such as cos(15 deg) may be related in a way that Coq does not see.
  [[nodiscard]] bool rests_on_numbers(const std::vector<std::size_t>& names, std::size_t itself) {
    return std::ranges::any_of(names, [&](std::size_t name) {
      return name != itself && !has_known_value(values_of_names_[name]) &&
             !has_variables(graph_, values_of_names_[name]);
    });
  }

  static Ball one() {
    Ball result;
    arb_one(result.get());
    return result;
  }

  Match multiple(const Rational& factor, std::size_t number, bool is_inverse) {
    const std::string& name = robot_.names[number];
    const NodeId node = variable(number), times = graph_.number(factor);
    const std::string text = coq_argument(factor.text());
    if (is_inverse) return {graph_.add(Op::kDivide, times, node), text + "*(/" + name + ')'};
    if (factor.text() == "1") return {node, name};
    return {graph_.add(Op::kMultiply, times, node), text + '*' + name};
  }

  /// The names that give way to their values, the newest ones first, until the numbers are equal
  /// whatever values the other names have.
  [[nodiscard]] std::vector<std::size_t> names_between(NodeId a, NodeId b) {
    std::vector<std::size_t> names;
    for (NodeId c = a, d = b; !are_equal(c, d);) {
      const auto newest = newest_name(c, d);
      if (!newest) return names;
      names.push_back(*newest);
      c = without(c, {*newest});
      d = without(d, {*newest});
    }
    for (std::size_t i = 0; i < names.size();) {
      std::vector<std::size_t> fewer = names;
      fewer.erase(fewer.begin() + std::ptrdiff_t(i));
      if (are_equal(without(a, fewer), without(b, fewer)))
        names = std::move(fewer);
      else
        ++i;
    }
    return names;
  }
  [[nodiscard]] NodeId without(NodeId node, const std::vector<std::size_t>& names) {
    for (const std::size_t name : names)
      node = replaced(graph_, node, {{variable(name), values_of_names_[name]}});
    return node;
  }
  [[nodiscard]] std::vector<std::string> texts_of(const std::vector<std::size_t>& names) const {
    std::vector<std::string> texts;
    for (const std::size_t name : names) texts.push_back(robot_.names[name]);
    return texts;
  }

  [[nodiscard]] bool are_equal(NodeId a, NodeId b) {
    if (a == b) return true;
    const NodeId c = unrelated_.of(a), d = unrelated_.of(b);
    return std::ranges::all_of(others_, [&](const Values& values) {
      const auto both = evaluate(graph_, {c, d}, values, kHintBits);
      return both && arb_overlaps((*both)[0].get(), (*both)[1].get()) != 0;
    });
  }

  [[nodiscard]] std::optional<std::size_t> newest_name(NodeId a, NodeId b) const {
    std::set<std::size_t> used;
    for (const NodeId id : ingredients(graph_, {a, b})) {
      const Node& node = graph_.nodes()[std::size_t(id)];
      if (node.op == Op::kVariable && values_of_names_[std::size_t(node.a)] != kNoNode)
        used.insert(std::size_t(node.a));
    }
    const auto newest = std::find_if(order_.rbegin(), order_.rend(),
                                     [&](std::size_t i) { return used.contains(i); });
    if (newest == order_.rend()) return std::nullopt;
    return *newest;
  }

  static constexpr std::size_t kMostRatioBits = 64;

  const Question& q_;
  RobotOfModel& robot_;
  const NamedMatrix& matrix_;
  Graph& graph_;
  std::vector<NodeId> values_of_names_;  ///< by variable; kNoNode: it is a quantity
  std::vector<std::size_t> order_;       ///< variables in the order in which a proof names them
  Unrelated unrelated_{graph_};          ///< what are_equal compares
  std::map<NodeId, NodeId> numbers_;     ///< names whose value is a rational number
  std::vector<Values> points_, others_;
  Scope commanded_, actual_, pose_scope_;
  MatrixHints hints_;
};

}  // namespace

MatrixHints find_matrix_hints(const Question& question, const std::vector<std::string>& lines,
                              RobotOfModel& robot, const NamedMatrix& matrix) {
  return HintSearch(question, robot, matrix).run(lines);
}

}  // namespace regulus::verifier
