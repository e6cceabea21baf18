// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_branch.hpp"

#include <utility>

#include "runtime/formal/coq_expression.hpp"
#include "runtime/formal/coq_load.hpp"
#include "runtime/formal/coq_question.hpp"
#include "runtime/verifier/branch_singular_values.hpp"
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
    const bool has_motors = !is_about_slopes_of_branch(question);
    write_question(has_motors);
    if (has_motors) write_motors();
    if (claimed_.kind == format::kForceLimits)
      write_limits();
    else if (has_motors)
      write_bound();
    else
      write_bound_of_slopes();
  }

  BranchQuantityText take() { return std::move(text_); }

 private:
  /// Each line `pose` has an error after this, if it is a motor.
  void write_question(bool has_motors) {
    const std::size_t before = q_.variables.size() - count(VariableKind::kError);
    for (std::size_t k = 0; k < before; ++k) text_.places.push_back(k);
    format::ClaimedSet set = q_.claimed_set();
    set.has_threshold = false;
    std::string text;
    for (const std::string& line : lines_) {
      if (line.starts_with("quantity ")) break;
      text += line.starts_with("claim ")     ? "claim "
              : line.starts_with("verdict ") ? "verdict NO SINGULARITY"
              : line.starts_with("alpha ")   ? "alpha 0"
                                             : line;
      if (line.starts_with("pose ")) {
        const bool has_error = line.find(" +- ") != std::string::npos;
        if (has_error) text_.places.push_back(before + motors_.size());
        if (!has_error && has_motors) text += " +- 0", ++set.uncertain;
        if (has_error || has_motors) motors_.push_back(before + motors_.size());
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

  /// The number of the claim; a threshold has no line `bound`.
  void write_limit() {
    const bool is_bound = !rests_of(lines_, "bound").empty();
    define("", "the_limit : expression",
           coq_expression(rests_of(lines_, is_bound ? "bound" : "alpha").front(), {}));
  }

  [[nodiscard]] std::string measure() const {
    const std::string unknown =
        claimed_.columns.empty() ? "" : std::to_string(claimed_.columns.front());
    if (claimed_.kind == format::kForce) return "Force " + std::to_string(claimed_.row);
    if (claimed_.kind != format::kDeflection) return "Motion " + unknown;
    return "Deflection " + unknown + "\n  " + expressions_of("stiffness");
  }

  void write_bound() {
    const bool is_motion = claimed_.kind == format::kError || claimed_.kind == format::kSpeed;
    if (!is_motion && claimed_.kind != format::kForce && claimed_.kind != format::kDeflection)
      throw Unfinished("there is no theorem about the quantity '" + claimed_.kind +
                       "' over a branch yet");
    define(
        "What is measured, the first motor or unknown being 0; over which vectors; and the limit.",
        "the_measure : measured", measure());
    define("", "the_vectors : vectors", is_motion ? motions() : load());
    write_limit();
    text_.claim = claimed_.side == format::kAbsolute  ? "branch_within"
                  : claimed_.side == format::kLargest ? "branch_below"
                                                      : "branch_above";
    text_.arguments = " the_motors the_measure the_vectors the_limit";
  }

  /// Writes the bound of the derivatives of the equations by the unknowns.
  void write_bound_of_slopes() {
    const bool is_spectrum = is_singular_value(claimed_.kind);
    if (is_spectrum || claimed_.kind == format::kCondition) {
      const bool is_ratio = !is_spectrum || claimed_.kind == format::kCondition2;
      define("The factors of the columns of the derivatives, and the limit of their " +
                 std::string(is_ratio ? "condition number." : "singular values."),
             "the_factors : list expression", expressions_of("factor"));
      text_.claim = !is_spectrum                         ? "branch_condition"
                    : is_ratio                           ? "branch_condition_2"
                    : claimed_.kind == format::kSigmaMin ? "branch_singular_values_above"
                                                         : "branch_singular_values_below";
      text_.arguments = " the_factors the_limit";
    } else {
      define(
          "On which side of the limit the determinant, or with Within and Beyond its magnitude, "
          "is.",
          "the_side : side",
          claimed_.kind == format::kDeterminant ? "Beyond"
          : claimed_.side == format::kAbsolute  ? "Within"
          : claimed_.side == format::kLargest   ? "Below"
                                                : "Above");
      text_.claim = "branch_determinant", text_.arguments = " the_side the_limit";
    }
    write_limit();
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

  [[nodiscard]] std::string expressions_of(std::string_view key) const {
    std::vector<CoqItem> items;
    for (const std::string& rest : rests_of(lines_, key))
      items.push_back({"", coq_expression(rest, {})});
    return coq_list(items, "   ");
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
  std::vector<std::size_t> motors_;  ///< by line `pose` with an error: its number
  BranchQuantityText text_;
};

}  // namespace

bool is_about_slopes_of_branch(const Question& question) {
  const auto is = [&](const char* kind) { return question.quantity->kind == kind; };
  return question.closure && question.quantity &&
         (is(format::kCondition) || is(format::kDeterminant) || is(format::kDeterminantMax) ||
          is_singular_value(question.quantity->kind));
}

BranchQuantityText split_branch(const Question& question, const std::vector<std::string>& lines) {
  return BranchWriter(question, lines).take();
}

}  // namespace regulus::verifier
