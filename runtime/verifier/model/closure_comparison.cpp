// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/closure_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "runtime/verifier/algebra.hpp"
#include "runtime/verifier/derivative.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/equality.hpp"
#include "runtime/verifier/model/model_file.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfClosure = 4096;
constexpr int kSmallerRadii = 4;          ///< of a start without one
constexpr long kMostTurnsOfUnknown = 16;  ///< after which an unknown may repeat
constexpr double kMostTurnsOfAngle = 1e6;
constexpr std::uint64_t kProductsOfTurns = 1 << 12;

bool is_degrees(const std::string& unit) { return unit == "deg" || unit == "°"; }

/// Tells what a step of a variable, which is some whole turns of it, keeps as it is.
class WholeTurns {
 public:
  /// `step`: a constant expression.
  WholeTurns(Graph& graph, std::size_t variable, NodeId step)
      : graph_(graph), by_(graph, variable), step_(step) {}

  /// True only if the variable stands in sines, cosines and tangents alone, of a number times it and of
  /// what does not depend on it. The step times this number is some whole turns.
  bool keep(NodeId id) {
    if (by_.of(id) == kNoNode) return true;
    const auto [at, is_new] = known_.emplace(id, false);
    if (is_new) at->second = are_kept(graph_.nodes()[std::size_t(id)]);
    return at->second;
  }

 private:
  bool are_kept(const Node node) {
    if (node.op == Op::kVariable) return false;
    const bool repeats = node.op == Op::kSin || node.op == Op::kCos || node.op == Op::kTan;
    if (repeats && has_whole_turns(node.a)) return true;
    return keep(node.a) && (operands(node.op) < 2 || keep(node.b));
  }

  bool has_whole_turns(NodeId id) {
    const NodeId slope = by_.of(id), angle = graph_.add(Op::kMultiply, slope, step_);
    for (const NodeId part : ingredients(graph_, {slope}))
      if (graph_.nodes()[std::size_t(part)].op == Op::kVariable) return false;
    const auto value = evaluate(graph_, {angle}, {}, kBitsOfClosure);
    if (!value) return false;
    const double turns = std::round(mid((*value)[0].enclosure()) / (2 * std::numbers::pi));
    if (!(std::fabs(turns) < kMostTurnsOfAngle)) return false;
    const NodeId whole =
        graph_.add(Op::kMultiply, graph_.number(Rational(2 * long(turns))), graph_.add(Op::kPi));
    return certain_equal(graph_, angle, whole, kProductsOfTurns);
  }

  Graph& graph_;
  Differentiator by_;
  const NodeId step_;
  std::map<NodeId, bool> known_;
};

class ClosureComparison {
 public:
  explicit ClosureComparison(QuestionComparer& comparer)
      : comparer_(comparer),
        q_(comparer.question()),
        values_(comparer.values()),
        closure_(*q_.closure) {}

  void run() {
    compare_names();
    for (std::size_t i = 0; i < closure_.equations.size(); ++i)
      require(equation(i), "equation " + std::to_string(i), q_.actual);
    if (values_.contains(equation(closure_.equations.size())))
      comparer_.refuse(comparer_.place_of(equation(closure_.equations.size())), "fewer equations");
    for (const std::string& name : closure_.names)
      q_.solutions ? compare_range(name) : compare_unknown(name);
    if (!q_.solutions) compare_start(), require_ranges();
    if (q_.has_threshold) require_radians();
    require_known_keys();
  }

 private:
  static std::string equation(std::size_t i) {
    return "closure.equations[" + std::to_string(i) + ']';
  }

  /// A threshold is one of a determinant by the numbers of the unknowns.
  void require_radians() {
    for (const std::string& name : closure_.names)
      if (is_in_degrees(name))
        throw Unfinished("closure.unknowns." + name +
                         " is in degrees: a threshold is of derivatives by radians");
  }

  void require(const std::string& place, const std::string& stated, const Scope& scope) {
    if (!values_.contains(place))
      comparer_.refuse_model("the file has no '" + place + "', but the certificate a line '" +
                             stated.substr(0, stated.find(' ')) + '\'');
    comparer_.compare_at(place, stated, scope);
  }

  /// Returns the values in a table, in the order of the file.
  [[nodiscard]] std::vector<std::pair<std::string, WrittenValue>> table(
      const std::string& prefix) const {
    std::vector<std::pair<std::string, WrittenValue>> result;
    for (auto at = values_.lower_bound(prefix);
         at != values_.end() && at->first.starts_with(prefix); ++at)
      result.emplace_back(at->first.substr(prefix.size()), at->second);
    std::ranges::sort(result, {}, [](const auto& entry) { return entry.second.number; });
    return result;
  }

  void compare_names() {
    std::vector<std::string> names;
    for (const auto& [name, unit] : table("closure.unknowns.")) names.push_back(name);
    if (names != closure_.names)
      comparer_.refuse_model("its unknowns are not those of the certificate, in their order");
  }

  void compare_unknown(const std::string& name) {
    const std::string start = "closure.start." + name, radius = "closure.radius." + name;
    const Scope none;
    require(start, "unknown " + name, none);
    if (values_.contains(radius)) return require(radius, "unknown-radius " + name, none);
    const FilePlace from{radius, 0, "not given"};
    if (const NodeId usual = usual_radius(name); usual != kNoNode)
      comparer_.compare(from, smaller_radius(name, usual), "unknown-radius " + name, "");
    else
      comparer_.leave_out(from, "it is not certain whether the start is greater than 1");
  }

  /// Compares where solutions are looked for: in the range, or, if whole turns of an angle change no
  /// equation and the range is longer, within half of the fewest such turns about its middle.
  void compare_range(const std::string& name) {
    const std::string place = "closure.range." + name, stated = "unknown-radius " + name;
    const bool is_given = values_.contains(place + "[0]");
    const FilePlace from =
        is_given ? comparer_.place_of(place + "[0]") : FilePlace{place, 0, "not given"};
    const auto [middle, half] = is_given ? given_range(name, place) : usual_range(name);
    if (middle == kNoNode)
      return comparer_.leave_out(from, "it is not certain whether the start is greater than 1");
    comparer_.compare(from, middle, "unknown " + name, "");
    const NodeId radius = q_.stated.at(stated).node;
    const long turns = is_angle(name) ? half_turns_of(name, radius) : 0;
    if (turns == 0 || !is_positive(q_.graph.add(Op::kSubtract, half, radius)))
      return comparer_.compare(from, half, stated, "");
    const long fewest = fewest_turns(name);
    if ((fewest == 0 || turns < fewest) && !is_changed_by(name, turns)) {
      comparer_.note_compared(stated);
      return comparer_.leave_out(from, "it is not certain whether the equations repeat after " +
                                           std::to_string(turns) + " turns of " + name);
    }
    comparer_.compare(from, fewest == turns ? radius : half, stated, "");
  }

  [[nodiscard]] bool is_in_degrees(const std::string& name) const {
    return is_degrees(values_.at("closure.unknowns." + name).text);
  }
  [[nodiscard]] bool is_angle(const std::string& name) const {
    return is_in_degrees(name) || values_.at("closure.unknowns." + name).text == "rad";
  }

  /// Returns n for n half turns of an unknown; 0 for any other number.
  long half_turns_of(const std::string& name, NodeId radius) {
    for (long n = 1; n <= kMostTurnsOfUnknown; ++n)
      if (equality(q_, radius, half_turns(name, n)) == Equality::kEqual) return n;
    return 0;
  }

  /// In the unit of the unknown.
  NodeId half_turns(const std::string& name, long n) {
    Graph& graph = q_.graph;
    if (is_in_degrees(name)) return graph.number(Rational(180 * n));
    return graph.add(Op::kMultiply, graph.number(Rational(n)), graph.add(Op::kPi));
  }

  /// Returns the least number of turns of an unknown that are seen to change no equation; 0: none.
  long fewest_turns(const std::string& name) {
    for (long n = 1; n <= kMostTurnsOfUnknown; ++n) {
      WholeTurns turns(q_.graph, number_of(name), half_turns(name, 2 * n));
      if (std::ranges::all_of(closure_.equations, [&](NodeId e) { return turns.keep(e); }))
        return n;
    }
    return 0;
  }

  /// True only if that many turns of an unknown change an equation.
  bool is_changed_by(const std::string& name, long turns) {
    const NodeId p = q_.actual.at(name),
                 moved = q_.graph.add(Op::kAdd, p, half_turns(name, 2 * turns));
    return std::ranges::any_of(closure_.equations, [&](NodeId e) {
      return equality(q_, e, replaced(q_.graph, e, {{p, moved}})) == Equality::kDifferent;
    });
  }

  /// Variables have other numbers than when they were read.
  [[nodiscard]] std::size_t number_of(const std::string& unknown) const {
    const Node node = q_.graph.nodes()[std::size_t(q_.actual.at(unknown))];
    if (node.op != Op::kVariable) throw Unfinished(unknown + " is no variable");
    return std::size_t(node.a);
  }

  [[nodiscard]] bool is_positive(NodeId node) const {
    const auto value = evaluate(q_.graph, {node}, {}, kBitsOfClosure);
    return value && arb_is_positive((*value)[0].get()) != 0;
  }

  /// The middle, and half of the width.
  std::pair<NodeId, NodeId> given_range(const std::string& name, const std::string& place) {
    Graph& graph = q_.graph;
    if (!values_.contains(place + "[1]")) throw Unfinished(place + " has no upper end");
    const NodeId lo = comparer_.number_at(place + "[0]", name),
                 hi = comparer_.number_at(place + "[1]", name), half = graph.number("0.5");
    return {graph.add(Op::kMultiply, half, graph.add(Op::kAdd, lo, hi)),
            graph.add(Op::kMultiply, half, graph.add(Op::kSubtract, hi, lo))};
  }

  /// Two turns about the start; of no angle 1000 times the greater of 1 and its magnitude.
  std::pair<NodeId, NodeId> usual_range(const std::string& name) {
    Graph& graph = q_.graph;
    const std::string place = "closure.start." + name;
    if (!values_.contains(place)) throw Unfinished("the file has no " + place);
    const NodeId start = comparer_.number_at(place, name);
    if (is_angle(name)) return {start, half_turns(name, 2)};
    const NodeId size = larger_of_one(start);
    if (size == kNoNode) return {kNoNode, kNoNode};
    return {start, graph.add(Op::kMultiply, graph.number("1000"), size)};
  }

  /// The file means nothing where an unknown leaves its range: there a square root has no value.
  void require_ranges() {
    Graph& graph = q_.graph;
    for (const std::string& name : closure_.names) {
      const std::string place = "closure.range." + name;
      if (!values_.contains(place + "[0]")) continue;
      const NodeId p = q_.actual.at(name);
      const auto expect = [&](const std::string& end, bool is_upper) {
        if (!values_.contains(end)) throw Unfinished(place + " has no upper end");
        const NodeId value = comparer_.number_at(end, name);
        comparer_.expect_defined(
            comparer_.place_of(end),
            graph.add(Op::kSqrt, is_upper ? graph.add(Op::kSubtract, value, p)
                                          : graph.add(Op::kSubtract, p, value)));
      };
      expect(place + "[0]", false);
      expect(place + "[1]", true);
    }
  }

  /// Returns the part of a usual radius, 1 or 1/10 to 1/10000, that the certificate states; else all of it.
  NodeId smaller_radius(const std::string& name, NodeId usual) {
    NodeId part = usual;
    for (int k = 0; k <= kSmallerRadii; ++k) {
      if (equality(q_, q_.stated.at("unknown-radius " + name).node, part) == Equality::kEqual)
        return part;
      part = q_.graph.add(Op::kDivide, part, q_.graph.number("10"));
    }
    return usual;
  }

  /// Without an entry it is 1/100 of a radian, or of the greater of 1 and the start's magnitude.
  NodeId usual_radius(const std::string& name) {
    Graph& graph = q_.graph;
    const NodeId hundredth = graph.number("0.01");
    if (is_in_degrees(name)) return graph.add(Op::kDivide, graph.number("1.8"), graph.add(Op::kPi));
    if (is_angle(name)) return hundredth;
    const NodeId size = larger_of_one(q_.stated.at("unknown " + name).node);
    return size == kNoNode ? kNoNode : graph.add(Op::kMultiply, hundredth, size);
  }

  /// Returns the greater of 1 and a magnitude; kNoNode: it is not certain which one that is.
  NodeId larger_of_one(NodeId value) {
    Graph& graph = q_.graph;
    const NodeId one = graph.number("1"), size = graph.add(Op::kAbs, value);
    const auto above = evaluate(graph, {graph.add(Op::kSubtract, size, one)}, {}, kBitsOfClosure);
    if (above && arb_is_positive((*above)[0].get()) != 0) return size;
    return above && arb_is_nonpositive((*above)[0].get()) != 0 ? one : kNoNode;
  }

  /// Returns the parameter of the motion that a pose parameter is, by name or by its line `pose`;
  /// empty if there is none.
  [[nodiscard]] std::string parameter_of(const std::string& name) const {
    if (q_.stated.contains("start " + name)) return name;
    const auto pose = q_.stated.find("pose " + name);
    if (pose == q_.stated.end()) return "";
    return q_.stated.contains("start " + pose->second.text) ? pose->second.text : "";
  }

  /// A pose parameter that is none of the motion is at its value at the start, too.
  void compare_start() {
    const Scope none;
    for (std::size_t k = 0; q_.continues && k < closure_.start.size(); ++k)
      comparer_.note_compared("start " + q_.variables[k].name);
    if (q_.continues) return;  // the first piece was compared
    for (const auto& [name, written] : table("closure.start.")) {
      const std::string place = "closure.start." + name;
      if (q_.stated.contains("unknown " + name)) continue;
      const std::string parameter = parameter_of(name);
      if (parameter == name)
        require(place, "start " + parameter, none);
      else if (q_.stated.contains("pose " + name))
        compare_pose_at_start(name, place, parameter);
      else
        comparer_.leave_out(comparer_.place_of(place),
                            "the certificate has no such pose parameter");
    }
    compare_lower_ends();
  }

  /// A motion by formulas begins at the start: there its parameters are at their lower ends, if they are
  /// no pose parameters themselves.
  void compare_lower_ends() {
    for (std::size_t k = 0; k < closure_.start.size(); ++k) {
      const std::string& parameter = q_.variables[k].name;
      if (!is_at_a_pose(parameter))
        comparer_.compare({"the start of the motion", 0, "the lower end of " + parameter},
                          q_.stated.at("lower " + parameter).node, "start " + parameter, "");
    }
  }

  /// The comparison of the motion has compared the formula with the file. `parameter`: that the pose
  /// parameter is; empty: none.
  void compare_pose_at_start(const std::string& name, const std::string& place,
                             const std::string& parameter) {
    std::map<NodeId, NodeId> start;
    for (std::size_t k = 0; k < closure_.start.size(); ++k)
      start.emplace(q_.graph.add(Op::kVariable, int(k)), closure_.start[k]);
    const NodeId value = replaced(q_.graph, q_.stated.at("pose " + name).node, start);
    if (equality(q_, value, comparer_.number_at(place, name)) != Equality::kEqual)
      comparer_.refuse(comparer_.place_of(place), "another value of " + name + " at the start");
    if (!parameter.empty()) comparer_.note_compared("start " + parameter);
  }

  /// True if a pose parameter is this parameter of the motion.
  [[nodiscard]] bool is_at_a_pose(const std::string& parameter) const {
    return std::ranges::any_of(table("closure.start."), [&](const auto& entry) {
      return parameter_of(entry.first) == parameter;
    });
  }

  void require_known_keys() {
    for (const auto& [key, written] : table("closure.")) {
      const std::string word = key.substr(0, key.find_first_of(".["));
      const bool is_known = word == "unknowns" || word == "equations" || word == "start" ||
                            word == "radius" || word == "range";
      if (!is_known)
        comparer_.leave_out(comparer_.place_of("closure." + key), "this reader does not know it");
    }
    for (const auto& [name, written] : table("closure.radius."))
      if (std::ranges::find(closure_.names, name) == closure_.names.end())
        comparer_.leave_out(comparer_.place_of("closure.radius." + name), "it is no unknown");
  }

  QuestionComparer& comparer_;
  Question& q_;
  const WrittenValues& values_;
  const ClosureLines& closure_;
};

}  // namespace

Question with_unknowns(const Question& question) {
  Question result = question;
  const ClosureLines& closure = *question.closure;
  for (std::size_t i = 0; i < closure.names.size(); ++i) {
    Graph& graph = result.graph;
    result.variables.push_back({closure.names[i], VariableKind::kParameter,
                                graph.add(Op::kSubtract, closure.middle[i], closure.radius[i]),
                                graph.add(Op::kAdd, closure.middle[i], closure.radius[i])});
    result.actual.emplace(closure.names[i],
                          graph.add(Op::kVariable, int(question.variables.size() + i)));
  }
  result.matrix = closure.equations;
  return result;
}

void compare_closure(QuestionComparer& comparer) { ClosureComparison(comparer).run(); }

}  // namespace regulus::verifier
