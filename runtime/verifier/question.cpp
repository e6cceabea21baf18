// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/question.hpp"

#include <algorithm>
#include <charconv>
#include <set>

#include "runtime/verifier/algebra.hpp"
#include "runtime/verifier/branch_quantity.hpp"
#include "runtime/verifier/closure_lines.hpp"
#include "runtime/verifier/load_lines.hpp"
#include "runtime/verifier/quantity_lines.hpp"
#include "runtime/verifier/solution_lines.hpp"

namespace regulus::verifier {
namespace {

constexpr std::uint64_t kProductsOfReach = 1 << 16;  ///< to show that two expressions are equal

/// Cuts `text` at the first `mark`; returns false if there is none.
bool cut(std::string_view text, std::string_view mark, std::string_view& before,
         std::string_view& after) {
  const std::size_t at = text.find(mark);
  if (at == std::string_view::npos) return false;
  before = text.substr(0, at);
  after = text.substr(at + mark.size());
  return true;
}

class QuestionReader {
 public:
  QuestionReader(Lines& lines, Question& question) : lines_(lines), q_(question) {}

  void read() {
    advance();
    q_.is_index = lines_.text() == format::kIndexMagic;
    if (!q_.is_index && lines_.text() != format::kMagic)
      throw Rejection("the first line is not '" + std::string(format::kMagic) + "'");
    advance();
    read_verdict();
    const std::string claim(take("claim"));
    read_labels();
    if (q_.solutions) return read_solutions(claim);
    read_alpha();
    read_variables();
    if (is("piecewise")) {
      q_.is_piecewise = true;
      return;
    }
    read_poses();
    keep_names();
    if (is("unknown")) {
      read_unknown_lines(lines_, q_, commanded_, actual_);
      q_.closure->poses = poses_;
    }
    read_model();
    read_motion();
    if (q_.load) read_load_lines(lines_, q_);
    if (q_.closure && q_.has_threshold)
      take_threshold_of_branch(q_);
    else if (!q_.load && is("quantity"))
      q_.closure ? read_branch_quantity_lines(lines_, q_) : read_quantity_lines(lines_, q_);
    read_end(claim, "the claim is not about this matrix and set");
  }

 private:
  void read_solutions(const std::string& claim) {
    if (is("alpha"))
      read_equations();
    else if (is("constant") || is("uncertain"))
      read_geometry();
    read_solution_lines(lines_, q_);
    read_end(claim, "the claim is not about these lines");
  }

  /// The constants of a robot that has tolerances.
  void read_geometry() {
    read_variables();
    q_.actual = geometry_;
  }

  /// All solutions of the equations of a closure, at one place.
  void read_equations() {
    read_alpha();
    read_variables();
    read_poses();
    keep_names();
    read_unknown_lines(lines_, q_, commanded_, actual_);
    read_model();
    read_motion();
    const bool has_range = std::ranges::any_of(
        q_.variables, [](const Variable& v) { return v.kind == VariableKind::kParameter; });
    if (has_range || !q_.constraints.empty() || q_.closure->names.empty())
      throw Rejection("a claim about all solutions has unknowns, no parameter and no constraint");
    if (q_.has_threshold) throw Rejection("a claim about all solutions has no threshold");
  }

  void read_end(const std::string& claim, const std::string& otherwise) const {
    if (lines_.text() != "proof") throw Rejection("expected the line 'proof'");
    if (claim != q_.claim()) throw Rejection(otherwise + ": expected '" + q_.claim() + "'");
  }

  void advance() {
    if (!lines_.next()) throw Rejection("the file ends before the proof");
    if (lines_.number() > format::kMostLines)
      throw Rejection("there are too many lines before 'proof'");
  }

  /// Returns true if the line is `key` alone, or begins with it and a space.
  bool is(std::string_view key) const {
    const std::string& line = lines_.text();
    return line.starts_with(key) && (line.size() == key.size() || line[key.size()] == ' ');
  }
  /// Returns the text after a key with which the line begins.
  std::string_view rest_of(std::string_view key) const {
    const std::string_view line = lines_.text();
    return line.substr(std::min(key.size() + 1, line.size()));
  }

  /// Returns the rest of a line that must begin with `key`, and goes to the next line.
  std::string take(std::string_view key) {
    if (!is(key)) throw Rejection("expected a line '" + std::string(key) + " …'");
    std::string rest(rest_of(key));
    advance();
    return rest;
  }

  void read_verdict() {
    const std::string verdict = take("verdict");
    q_.singular = verdict == format::kSingularity || verdict == format::kInfeasible;
    q_.paves = verdict == format::kPaving;
    if (verdict == format::kFeasible || verdict == format::kInfeasible ||
        verdict == format::kPaving)
      q_.load.emplace().verdict = verdict;
    else if (verdict == format::kComplete || verdict == format::kNone ||
             verdict == format::kIncomplete)
      q_.solutions.emplace().verdict = verdict;
    else if (!q_.singular && verdict != format::kNoSingularity)
      throw Rejection("the verdict is not " + std::string(format::kNoSingularity) + ", " +
                      format::kSingularity + ", " + format::kFeasible + ", " + format::kInfeasible +
                      ", " + format::kPaving + ", " + format::kComplete + ", " + format::kNone +
                      " or " + format::kIncomplete);
  }

  void read_labels() {
    q_.model = take("model");
    q_.sha256 = take("sha256");
    q_.motion = take("motion");
  }

  void read_alpha() {
    const std::string alpha = take("alpha");
    q_.alpha = note("alpha", "", constant(alpha), alpha);
    q_.has_threshold = alpha != "0";
  }

  NodeId constant(std::string_view text) { return parse(text, {}, q_.graph); }

  /// Records the value that a line states.
  NodeId note(std::string_view kind, std::string_view name, NodeId node, std::string_view text) {
    std::string key(kind);
    key += ' ';
    key += name;
    q_.stated.emplace(key, StatedValue{node, lines_.number(), std::string(text)});
    return node;
  }

  void declare(Scope& scope, std::string_view name, NodeId meaning) {
    if (!is_name(name) || is_reserved(name))
      throw Rejection("'" + std::string(name) + "' cannot be a name");
    if (!scope.emplace(name, meaning).second)
      throw Rejection("'" + std::string(name) + "' is declared twice");
  }

  NodeId add_variable(std::string name, VariableKind kind, NodeId lo, NodeId hi) {
    if (q_.variables.size() == format::kMostVariables) throw Rejection("too many variables");
    const NodeId node = q_.graph.add(Op::kVariable, int(q_.variables.size()));
    q_.variables.push_back({std::move(name), kind, lo, hi});
    return node;
  }

  /// Reads the lines parameter, constant, uncertain and ball.
  void read_variables() {
    std::string_view name, value, lo, hi;
    while (is("parameter")) {
      if (!cut(rest_of("parameter"), " in ", name, value) || !cut(value, " : ", lo, hi))
        throw Rejection("expected 'parameter NAME in LO : HI'");
      declare(parameters_, name,
              add_variable(std::string(name), VariableKind::kParameter,
                           note("lower", name, constant(lo), lo),
                           note("upper", name, constant(hi), hi)));
      advance();
    }
    for (;; advance()) {
      if (is("constant") && cut(rest_of("constant"), " = ", name, value))
        declare(geometry_, name, note("value", name, constant(value), value));
      else if (is("uncertain") && cut(rest_of("uncertain"), " = ", name, value) &&
               cut(value, " +- ", lo, hi))
        read_uncertain(std::string(name), note("value", name, constant(lo), lo),
                       note("spread", name, constant(hi), hi));
      else if (is("ball"))
        read_ball(rest_of("ball"));
      else
        return;
    }
  }

  void read_uncertain(const std::string& name, NodeId middle, NodeId spread) {
    spreads_.resize(q_.variables.size(), -1);
    spreads_.push_back(spread);
    middles_.resize(q_.variables.size(), -1);
    middles_.push_back(middle);
    declare(
        geometry_, name,
        add_variable(name, VariableKind::kUncertain, q_.graph.add(Op::kSubtract, middle, spread),
                     q_.graph.add(Op::kAdd, middle, spread)));
  }

  /// Reads names of earlier uncertain quantities with one spread, none of them in two balls.
  void read_ball(std::string_view names) {
    BallOfVariables ball;
    while (!names.empty()) {
      std::string_view name = names, rest;
      if (cut(names, " ", name, rest))
        names = rest;
      else
        names = {};
      const auto found = geometry_.find(name);
      const Node node =
          found == geometry_.end() ? Node{Op::kPi} : q_.graph.nodes()[std::size_t(found->second)];
      if (node.op != Op::kVariable || !in_ball_.insert(node.a).second)
        throw Rejection("'" + std::string(name) + "' cannot be a coordinate of this ball");
      const NodeId spread = spreads_[std::size_t(node.a)];
      if (!ball.members.empty() && spread != ball.radius)
        throw Rejection("the coordinates of a ball have different radii");
      ball.radius = spread;
      ball.members.push_back(std::size_t(node.a));
      ball.middles.push_back(middles_[std::size_t(node.a)]);
    }
    if (ball.members.empty()) throw Rejection("a ball has no coordinates");
    q_.balls.push_back(std::move(ball));
  }

  /// Reads pose NAME = EXPRESSION [+- ERROR]: commanded in constraints, with error in the matrix.
  void read_poses() {
    Scope scope = parameters_;
    for (const auto& [name, node] : geometry_) declare(scope, name, node);
    commanded_ = scope;
    actual_ = geometry_;
    std::string_view name, value, expression, error;
    for (; is("pose"); advance()) {
      if (!cut(rest_of("pose"), " = ", name, value)) throw Rejection("expected 'pose NAME = …'");
      const bool has_error = cut(value, " +- ", expression, error);
      const std::string_view text = has_error ? expression : value;
      const NodeId commanded = note("pose", name, parse(text, scope, q_.graph), text);
      read_pose(std::string(name), commanded,
                has_error ? note("error", name, constant(error), error) : -1);
    }
  }

  void read_pose(const std::string& name, NodeId commanded, NodeId error) {
    poses_.push_back(name);
    // A commanded pose must have a value: the motion means nothing where it has none.
    q_.motion_defined.push_back(commanded);
    NodeId actual = commanded;
    if (error >= 0)
      actual = q_.graph.add(Op::kAdd, commanded,
                            add_variable(name + " error", VariableKind::kError,
                                         q_.graph.add(Op::kNegate, error), error));
    declare(actual_, name, actual);
    // A parameter of the same name must be the same quantity: constraints may use both.
    const auto known = commanded_.find(name);
    if (known != commanded_.end() && known->second != commanded)
      throw Rejection("'" + name + "' is a parameter, and another pose parameter");
    commanded_.emplace(name, commanded);
  }

  /// Saves the names of the model, before a `let` of the file can use one of them.
  void keep_names() {
    q_.actual = actual_;
    q_.commanded = commanded_;
  }

  void read_model() {
    std::string_view name, value;
    for (; is("let"); advance()) {
      if (!cut(rest_of("let"), " = ", name, value)) throw Rejection("expected 'let NAME = …'");
      declare(actual_, name, parse(value, actual_, q_.graph));
      if (q_.closure) q_.closure->lets.emplace_back(name, value);
    }
    if (q_.closure)
      read_equation_lines(lines_, q_, actual_);
    else
      read_matrix();
    read_list("defined", actual_, q_.defined);
  }

  void read_matrix() {
    std::string_view name, value;
    const std::string shape = take("matrix");
    if (!cut(shape, " ", name, value)) throw Rejection("expected 'matrix ROWS COLUMNS'");
    q_.rows = read_count(name, format::kMostRows);
    q_.columns = read_count(value, q_.rows);
    if (q_.columns < 1) throw Rejection("the matrix has no columns");
    for (std::size_t e = 0; e < q_.rows * q_.columns; ++e) {
      if (!is("entry")) throw Rejection("expected a line 'entry …'");
      const std::string_view text = rest_of("entry");
      q_.matrix.push_back(note("entry", std::to_string(e), parse(text, actual_, q_.graph), text));
      advance();
    }
    read_list("scale", actual_, q_.scale);
    if (!q_.scale.empty() && q_.scale.size() != q_.rows)
      throw Rejection("the number of scales differs from the number of rows");
  }

  void read_motion() {
    read_list("motion-defined", commanded_, q_.motion_defined);
    read_reach();
    read_list("constraint", commanded_, q_.constraints);
    if (q_.has_threshold && q_.rows != q_.columns) throw Rejection("alpha needs a square matrix");
  }

  /// Reads `reach E`: E ≥ 0 in the variety. It must be the operand of a root of the model, so that
  /// poses where E < 0 are none of the robot.
  void read_reach() {
    std::vector<NodeId> operands;
    for (const Node& node : q_.graph.nodes())
      if (node.op == Op::kSqrt) operands.push_back(node.a);
    for (std::size_t number = 0; is("reach"); ++number, advance()) {
      const std::string_view text = rest_of("reach");
      const NodeId claimed = parse(text, actual_, q_.graph);
      if (std::none_of(operands.begin(), operands.end(), [&](NodeId operand) {
            return certain_equal(q_.graph, operand, claimed, kProductsOfReach);
          }))
        throw Rejection("the model has no square root of '" + std::string(text.substr(0, 80)) +
                        "', so that a pose where it is negative can be one of the robot");
      const NodeId operand =
          note("reach", std::to_string(number), parse(text, commanded_, q_.graph), text);
      q_.constraints.push_back(q_.graph.add(Op::kNegate, operand));
      q_.is_within_reach = true;
    }
  }

  void read_list(std::string_view key, const Scope& scope, std::vector<NodeId>& list) {
    for (std::size_t number = 0; is(key); ++number, advance()) {
      const std::string_view text = rest_of(key);
      list.push_back(note(key, std::to_string(number), parse(text, scope, q_.graph), text));
    }
  }

  Lines& lines_;
  Question& q_;
  Scope parameters_, geometry_, commanded_, actual_;
  std::vector<NodeId> middles_, spreads_;  ///< of each variable that is an uncertain quantity
  std::set<int> in_ball_;
  std::vector<std::string> poses_;
};

}  // namespace

format::ClaimedSet Question::claimed_set() const {
  format::ClaimedSet set{rows, columns, 0, has_threshold, is_within_reach};
  for (const Variable& v : variables) set.uncertain += v.kind != VariableKind::kParameter;
  return set;
}

std::string Question::claim() const {
  if (solutions)
    return format::describe_solutions_claim({solutions->verdict,
                                             closure          ? format::kOfUnknowns
                                             : solutions->arm ? solutions->arm->description()
                                             : solutions->legs.size() == 3 ? format::kOfThreeLegs
                                                                           : format::kOfSixLegs,
                                             closure          ? "configuration"
                                             : solutions->arm ? "posture"
                                                              : "pose",
                                             closure          ? "configurations"
                                             : solutions->arm ? "postures"
                                                              : "poses",
                                             solutions->solutions.size(), claimed_set().uncertain});
  if (load) return format::describe_load_claim(claimed_set(), load->verdict);
  if (quantity) return quantity->claim;
  if (closure && paves) return format::describe_branch_paving(claimed_set(), "");
  if (closure) return format::describe_closure_claim(claimed_set(), singular);
  return format::describe_claim(claimed_set(), singular);
}

void read_question(Lines& lines, Question& question) { QuestionReader(lines, question).read(); }

std::size_t read_count(std::string_view text, std::size_t most) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value > most)
    throw Rejection("found '" + std::string(text.substr(0, 40)) + "', expected a number up to " +
                    std::to_string(most));
  return value;
}

}  // namespace regulus::verifier
