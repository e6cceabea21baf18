// SPDX-License-Identifier: GPL-3.0-or-later
// Fewer terms do not mean narrower bounds. For a Gough platform with exact anchors, moments about a
// point of the base save a quarter of the boxes; with wide tolerances they cost some. So the bounds
// decide, over boxes about as large as those that a search certifies.
#include "codegen/kernel/columns/column_choice.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "codegen/kernel/symbolic/measure.hpp"

namespace regulus::detail {
namespace {

/// Pairs of terms compared: of the order of ten milliseconds.
constexpr std::uint64_t kMostPairs = 400000;
/// Bounds are formed only for matrices up to this many terms: of the order of ten milliseconds,
/// too.
constexpr std::size_t kMostTerms = 2000;
/// The gain that operations must have to be kept, because the radius is an estimate. On the paper's
/// robots a gain of 7 % or more meant fewer boxes; 5 % once meant more.
constexpr double kLeastGain = 0.93;
/// After this many halvings a box is compared as it is.
constexpr int kMostHalvings = 8;

double geometric_mean(const std::vector<double>& x) {
  double sum = 0;
  for (const double value : x) sum += std::log(value);
  return std::exp(sum / static_cast<double>(x.size()));
}

std::function<bool(Atom)> touching_several_rows(const AtomTable& atoms,
                                                const BoundsSetting& setting) {
  return [&atoms, &setting](Atom a) {
    const Expression& e = atoms.variable_expression(a);
    if (!e.is_total()) return false;
    const Occurrences occurrences = count_occurrences(e);
    for (std::size_t v = 0; v < setting.variables.size(); ++v)
      if (setting.row_of_variable[v] != Expansion::kNoRow &&
          occurrences.count(setting.variables[v].name) != 0)
        return false;
    return true;
  };
}

class ColumnChoice {
 public:
  ColumnChoice(const PolynomialMatrix& A, Rewriter& rewriter, const BoundsSetting& setting)
      : A_(A), rewriter_(rewriter), setting_(setting) {}

  ColumnDecision run() && {
    const auto may_multiply = touching_several_rows(rewriter_.atoms(), setting_);
    ShorteningOperations found = find_shortening_operations(A_, may_multiply, kMostPairs);
    ColumnTrials& trials = decision_.trials;
    trials.terms_before = found.terms_before;
    trials.terms_after = found.terms_after;
    trials.complete = found.complete && found.terms_before <= kMostTerms;
    if (found.operations.empty() || found.terms_before > kMostTerms) return std::move(decision_);
    if (A_.rows() > static_cast<int>(kMaxRows) || A_.columns > static_cast<int>(kMaxColumns))
      return std::move(decision_);
    for (const ColumnOperation& operation : found.operations)
      trials.tried.push_back(in_words(operation));
    if (!choose_boxes()) return std::move(decision_);
    try_operations(found.operations, trials.radius_of_all);
    try_operations(scaled(found.operations, cln::cl_RA(1) / 2), trials.radius_of_half);
    for (const ColumnOperation& operation : decision_.kept)
      trials.kept.push_back(in_words(operation));
    return std::move(decision_);
  }

 private:
  AppliedOperation in_words(const ColumnOperation& operation) const {
    return {
        operation.target, operation.source,
        product({Expression(operation.factor), monomial(operation.multiplier, rewriter_.atoms())})};
  }

  /// Chooses boxes on which A is just certified, unless it is certified on the whole motion.
  bool choose_boxes() {
    ApproxBounds bounds(A_, rewriter_, setting_);
    boxes_ = bounds.whole();
    std::vector<double> radii = bounds.radii(boxes_);
    int& halvings = decision_.trials.halvings;
    for (; halvings < kMostHalvings && !(geometric_mean(radii) < 1); ++halvings) {
      bounds.split(boxes_, radii);
      radii = bounds.radii(boxes_);
    }
    decision_.trials.radius = least_ = geometric_mean(radii);
    return halvings > 0 && std::isfinite(least_);
  }

  void try_operations(const std::vector<ColumnOperation>& operations, double& radius) {
    PolynomialMatrix AV = A_;
    for (const ColumnOperation& operation : operations) apply(operation, AV);
    radius = geometric_mean(ApproxBounds(AV, rewriter_, setting_).radii(boxes_));
    if (!(radius < kLeastGain * least_)) return;
    least_ = radius;
    decision_.kept = operations;
  }

  const PolynomialMatrix& A_;
  Rewriter& rewriter_;
  const BoundsSetting& setting_;
  ColumnDecision decision_;
  SampleBoxes boxes_;
  double least_ = 0;
};

}  // namespace

ColumnDecision choose_columns(const PolynomialMatrix& A, Rewriter& rewriter,
                              const BoundsSetting& setting) {
  return ColumnChoice(A, rewriter, setting).run();
}

}  // namespace regulus::detail
