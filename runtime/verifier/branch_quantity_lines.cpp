// SPDX-License-Identifier: Apache-2.0
// Reads the lines of a quantity over a branch.
#include <algorithm>
#include <map>
#include <span>

#include "runtime/verifier/branch_quantity.hpp"
#include "runtime/verifier/branch_singular_values.hpp"
#include "runtime/verifier/constant_lines.hpp"
#include "runtime/verifier/derivative.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/outside.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/quantity_lines.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfThreshold = 128;

class BranchQuantityReader {
 public:
  BranchQuantityReader(Lines& lines, Question& q)
      : lines_(lines, q), q_(q), closure_(*q.closure), quantity_(q.quantity.emplace()) {
    words_.is_of_closure = true;
  }

  void read() {
    quantity_.kind = words_.quantity = lines_.take("quantity");
    if (is_of({format::kForceLimits})) return read_limits();
    if (q_.paves) throw Rejection("a paving of a branch has no bound of a quantity");
    quantity_.side = words_.side = lines_.take("side");
    require_side();
    const std::size_t motors = closure_.poses.size();
    if (is_of({format::kForce}))
      quantity_.row = number_from_one(words_.row = lines_.take("row"), motors);
    if (is_of({format::kError, format::kFiniteError, format::kSpeed, format::kDeflection}))
      quantity_.columns = {number_from_one(words_.columns = lines_.take("column"), q_.columns)};
    if (is_of({format::kForce, format::kDeflection})) read_load();
    if (is_of({format::kError})) quantity_.errors = lines_.list("motor-error", motors);
    if (is_of({format::kSpeed})) quantity_.speeds = lines_.list("motor-speed", motors);
    if (is_of({format::kDeflection})) quantity_.stiffness = lines_.list("stiffness", motors);
    if (is_of({format::kCondition}) || is_singular_value(quantity_.kind))
      quantity_.factors = lines_.list("factor", q_.columns);
    words_.bound = lines_.take("bound");
    quantity_.bound = parse(words_.bound, {}, q_.graph);
    finish();
  }

 private:
  void read_limits() {
    read_load();
    for (std::size_t k = 0; k < closure_.poses.size(); ++k) {
      const auto [least, largest] = lines_.two_parts("limits", " : ");
      quantity_.least.push_back(lines_.constant("least", k, least));
      quantity_.largest.push_back(lines_.constant("largest", k, largest));
      lines_.advance();
    }
    finish();
  }

  void finish() {
    quantity_.claim = q_.paves
                          ? format::describe_branch_paving(q_.claimed_set(), words_.set)
                          : format::describe_bound_claim(q_.claimed_set(), words_, q_.singular);
    if (has_branch_rates(quantity_.kind)) derive_by_motors();
  }

  [[nodiscard]] bool is_of(std::initializer_list<const char*> kinds) const {
    return std::ranges::find(kinds, quantity_.kind) != kinds.end();
  }

  void require_side() const {
    const bool is_signed = is_of({format::kForce, format::kDeflection, format::kDeterminantMax});
    const bool is_known =
        quantity_.side == format::kLeast
            ? is_signed || is_of({format::kDeterminant, format::kSigmaMin})
        : quantity_.side == format::kLargest ? is_signed
        : quantity_.side == format::kAbsolute
            ? is_signed || is_of({format::kError, format::kFiniteError, format::kSpeed,
                                  format::kCondition, format::kCondition2, format::kSigmaMax})
            : false;
    if (!is_known)
      throw Rejection("there is no quantity '" + quantity_.kind.substr(0, 40) +
                      "' of a closure with the side '" + quantity_.side.substr(0, 40) + "'");
  }

  static std::size_t number_from_one(std::string_view word, std::size_t most) {
    const std::size_t number = read_count(word, most);
    if (number == 0) throw Rejection("motors and unknowns have numbers from 1");
    return number - 1;
  }

  void read_load() {
    quantity_.set_kind = "load";
    VectorSetLines& set = quantity_.set.emplace();
    set.name = words_.set = lines_.take("load");
    if (!is_label(set.name)) throw Rejection("the name of the load is not a name");
    lines_.read_set(set);
  }

  /// Reads the equations once more, with a variable d_k added to each pose parameter: ∂Φ/∂d_k at
  /// d = 0 is the derivative by it.
  void derive_by_motors() {
    Graph& graph = q_.graph;
    const std::size_t first = q_.variables.size() + closure_.names.size();
    const NodeId zero = graph.number("0");
    std::map<NodeId, NodeId> at_zero;
    Scope scope = q_.actual;
    for (std::size_t i = 0; i < closure_.names.size(); ++i)
      scope.emplace(closure_.names[i], graph.add(Op::kVariable, int(q_.variables.size() + i)));
    for (std::size_t k = 0; k < closure_.poses.size(); ++k) {
      const NodeId moved = graph.add(Op::kVariable, int(first + k));
      at_zero.emplace(moved, zero);
      NodeId& pose = scope.at(closure_.poses[k]);
      pose = graph.add(Op::kAdd, pose, moved);
    }
    for (const auto& [name, text] : closure_.lets) scope.emplace(name, parse(text, scope, graph));
    for (std::size_t j = 0; j < closure_.equations.size(); ++j) {
      const NodeId equation =
          parse(q_.stated.at("equation " + std::to_string(j)).text, scope, graph);
      for (std::size_t k = 0; k < closure_.poses.size(); ++k) {
        const NodeId by = Differentiator(graph, first + k).of(equation);
        quantity_.by_motor.push_back(by == kNoNode ? zero : replaced(graph, by, at_zero));
      }
    }
    for (const NodeId kink : kinks_of(graph, quantity_.by_motor)) q_.defined.push_back(kink);
  }

  ConstantLines lines_;
  Question& q_;
  const ClosureLines& closure_;
  QuantityLines& quantity_;
  format::ClaimedBound words_;
};

}  // namespace

bool has_branch_rates(const std::string& kind) {
  return kind == format::kForce || kind == format::kForceLimits || kind == format::kError ||
         kind == format::kSpeed || kind == format::kDeflection;
}

bool is_finite_error(const Question& question) {
  return question.closure && question.quantity && question.quantity->kind == format::kFiniteError;
}

bool has_threshold_of_branch(const Question& question) {
  return question.closure && question.has_threshold;
}

void take_threshold_of_branch(Question& q) {
  const auto alpha = evaluate(q.graph, {q.alpha}, {}, kBitsOfThreshold);
  if (!alpha || arb_is_nonnegative((*alpha)[0].get()) == 0)
    throw Unfinished("alpha is not certainly 0 or positive");
  QuantityLines& quantity = q.quantity.emplace();
  quantity.kind = format::kDeterminant;
  quantity.side = format::kLeast;
  quantity.bound = q.alpha;
  quantity.claim = q.paves ? format::describe_branch_paving(q.claimed_set(), "")
                           : format::describe_closure_claim(q.claimed_set(), q.singular);
}

void show_threshold_by_fold(Question& q) {
  if (has_threshold_of_branch(q) && q.singular) q.quantity.reset();
}

bool is_attained_bound(const Question& question) {
  return question.closure && question.quantity && question.singular;
}

void read_value_line(Lines& lines, Question& q, const Variety& variety) {
  if (!lines.next()) throw Rejection("the file ends before the line 'end' of the tree");
  const auto words = words_of(lines.text());
  if (words[0] != format::kValue)
    throw Rejection(std::string("expected the word '") + format::kValue + "'");
  read_place_of_value(std::span(words).subspan(1), q, variety);
}

void read_place_of_value(std::span<const std::string_view> words, Question& q,
                         const Variety& variety) {
  if (words.size() != q.variables.size())
    throw Rejection(std::string("expected '") + format::kValue + "' and " +
                    std::to_string(q.variables.size()) + " numbers or words '" +
                    format::kOnlyValue + "'");
  Box& place = q.quantity->attained.emplace();
  for (std::size_t k = 0; k < q.variables.size(); ++k) {
    const bool is_only = words[k] == format::kOnlyValue;
    if (is_only && variety.inner[k])
      throw Rejection(q.variables[k].name + " has more values than one, or a double");
    place.push_back(is_only ? variety.outer[k] : point(read_double(words[k])));
  }
  if (certain_outside(q, variety, place))
    throw Rejection("the place of the value is outside the ranges or the balls");
  if (!is_certain_point(q, variety, place))
    throw Unfinished("the place of the value is not certainly in the set");
}

void read_branch_quantity_lines(Lines& lines, Question& question) {
  BranchQuantityReader(lines, question).read();
}

}  // namespace regulus::verifier
