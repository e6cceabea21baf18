// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_branch.hpp"

#include <utility>

#include "runtime/formal/coq_expression.hpp"
#include "runtime/formal/coq_load.hpp"
#include "runtime/formal/coq_question.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

/// `[0; 2]%nat`
std::string coq_numbers(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (const std::size_t k : numbers) text += (text.empty() ? "[" : "; ") + std::to_string(k);
  return (text.empty() ? "[" : text) + "]%nat";
}

/// `E : E` or `E +- E`
CoqItem coq_pair(std::string_view rest, std::string_view mark) {
  const std::string first = coq_expression(take_until(rest, mark), {});
  return {"", "(" + first + ", " + coq_expression(rest, {}) + ")"};
}

class BranchWriter {
 public:
  BranchWriter(const Question& question, const std::vector<std::string>& lines)
      : q_(question), claimed_(*question.quantity), lines_(lines) {
    if (q_.singular)
      throw Unfinished("there is no theorem yet that a value is attained on a branch");
    write_question();
    write_motors();
    if (claimed_.kind == format::kForceLimits)
      write_limits();
    else
      write_bound();
  }

  BranchQuantityText take() { return std::move(text_); }

 private:
  /// Each line `pose` has an error after this.
  void write_question() {
    const std::size_t before = q_.variables.size() - count(VariableKind::kError);
    for (std::size_t k = 0; k < before; ++k) text_.places.push_back(k);
    format::ClaimedSet set = q_.claimed_set();
    std::string text;
    for (const std::string& line : lines_) {
      if (line.starts_with("quantity ")) break;
      text += line.starts_with("claim ")     ? "claim "
              : line.starts_with("verdict ") ? "verdict NO SINGULARITY"
                                             : line;
      if (line.starts_with("pose ")) {
        const bool has_error = line.find(" +- ") != std::string::npos;
        if (has_error) text_.places.push_back(before + motors_.size());
        if (!has_error) text += " +- 0", ++set.uncertain;
        motors_.push_back(before + motors_.size());
      }
      if (line.starts_with("claim ")) after_claim_ = text.size();
      text += '\n';
    }
    text.insert(after_claim_, format::describe_closure_claim(set, false));
    text_.question = text + "proof\n";
  }

  [[nodiscard]] std::size_t count(VariableKind kind) const {
    std::size_t found = 0;
    for (const Variable& v : q_.variables) found += v.kind == kind;
    return found;
  }

  void define(const std::string& comment, const std::string& head, const std::string& body) {
    if (!comment.empty()) text_.definitions += "\n(** " + comment + " *)\n";
    text_.definitions += "Definition " + head + " := " + body + ".\n";
  }

  void write_motors() {
    define("The motors: the errors of the pose parameters, as numbers of variables.",
           "the_motors : list nat", coq_numbers(motors_));
  }

  void write_bound() {
    const bool is_force = claimed_.kind == format::kForce;
    if (!is_force && claimed_.kind != format::kError && claimed_.kind != format::kSpeed)
      throw Unfinished("there is no theorem about the quantity '" + claimed_.kind +
                       "' over a branch yet");
    define(
        "What is measured, the first motor or unknown being 0; over which vectors; and the limit.",
        "the_measure : measured",
        is_force ? "Force " + std::to_string(claimed_.row)
                 : "Motion " + std::to_string(claimed_.columns.front()));
    define("", "the_vectors : vectors", is_force ? load() : motions());
    define("", "the_limit : expression", coq_expression(rests_of(lines_, "bound").front(), {}));
    text_.claim = claimed_.side == format::kAbsolute  ? "branch_within"
                  : claimed_.side == format::kLargest ? "branch_below"
                                                      : "branch_above";
    text_.arguments = " the_motors the_measure the_vectors the_limit";
  }

  void write_limits() {
    define("The load, and the least and the largest force of each motor.", "the_vectors : vectors",
           load());
    std::vector<CoqItem> limits;
    for (const std::string& rest : rests_of(lines_, "limits"))
      limits.push_back(coq_pair(rest, " : "));
    define("", "the_limits : list (expression * expression)", coq_list(limits, "   "));
    text_.claim = "branch_within_limits";
    text_.arguments = " the_motors the_vectors the_limits";
  }

  [[nodiscard]] std::string load() const {
    require_vectors(q_, claimed_.set->spread);
    std::vector<CoqItem> components, balls;
    for (const std::string& rest : rests_of(lines_, "wrench"))
      components.push_back(coq_pair(rest, " +- "));
    const std::vector<std::string> radii = rests_of(lines_, "wrench-ball");
    for (std::size_t b = 0; b < radii.size(); ++b) {
      std::string_view radius = radii[b];
      require_vectors(q_, {claimed_.set->balls[b].radius});
      balls.push_back({"", "(" + coq_expression(take_until(radius, " in "), {}) + ", " +
                               coq_numbers(claimed_.set->balls[b].members) + ")"});
    }
    return "Vectors\n  " + coq_list(components, "   ") + "\n  " + coq_list(balls, "   ");
  }

  /// The errors or the speeds of the motors.
  [[nodiscard]] std::string motions() const {
    const bool is_error = claimed_.kind == format::kError;
    require_vectors(q_, is_error ? claimed_.errors : claimed_.speeds);
    std::vector<CoqItem> components;
    for (const std::string& rest : rests_of(lines_, is_error ? "motor-error" : "motor-speed"))
      components.push_back({"", "(0, " + coq_expression(rest, {}) + ")"});
    return "Vectors\n  " + coq_list(components, "   ") + "\n  []";
  }

  const Question& q_;
  const QuantityLines& claimed_;
  const std::vector<std::string>& lines_;
  std::size_t after_claim_ = 0;
  std::vector<std::size_t> motors_;  ///< by line `pose`: the number of its error
  BranchQuantityText text_;
};

}  // namespace

BranchQuantityText split_branch(const Question& question, const std::vector<std::string>& lines) {
  return BranchWriter(question, lines).take();
}

}  // namespace regulus::verifier
