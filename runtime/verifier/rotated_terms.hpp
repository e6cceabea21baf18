// SPDX-License-Identifier: Apache-2.0
// B = UᵀAV over a box, to the first or to the second order. PROOF.md, "The condition number in the
// 2-norm", derives the bounds.
#pragma once

#include "runtime/verifier/expansion.hpp"
#include "runtime/verifier/singular_bases.hpp"
#include "runtime/verifier/slopes.hpp"

namespace regulus::verifier {

/// B(x) ∈ center + Σ_k slopes[k]·δ_k + [−rest, rest], |δ_k| ≤ radius[k]. Matrices are row by row.
struct RotatedMatrix {
  std::vector<Interval> center;
  std::vector<std::vector<Interval>> slopes;
  std::vector<double> rest;
  std::vector<std::size_t> variable;  ///< by k
  std::vector<double> radius;         ///< the same
  std::vector<double> share;          ///< roughly what each adds to the entries of `rest`
};

/// Adds the contribution of an entry x = A_ij to UᵀAV.
void add_rotated(std::vector<Interval>& sum, Interval x, const SingularBases& bases, std::size_t i,
                 std::size_t j, std::size_t rows, std::size_t columns);

/// Returns B from the slopes of A.
///
/// Requires  slopes.run() was true.
[[nodiscard]] RotatedMatrix rotate(const MatrixSlopes& slopes, const SingularBases& bases,
                                   std::size_t rows, std::size_t columns);

/// A = diag(s)·Σ_μ C_μ·μ with constant matrices C_μ. The columns of ΣC_μ·μ are rotated before anything
/// is enclosed, so that terms cancel, and the scales s stay apart.
class RotatedTerms {
 public:
  /// Adds derivatives to the question's graph, unless there are too many.
  ///
  /// Requires  is_about_ratio().
  explicit RotatedTerms(Question& question);

  /// Returns nullopt if there are too many derivatives, or one of them is not bounded.
  [[nodiscard]] std::optional<RotatedMatrix> rotate(const Box& box, const Middle& middle,
                                                    const SingularBases& bases);

 private:
  using Intervals = std::vector<Interval>;

  /// The first and second derivatives of a monomial, or of a scale; by variable, by pair.
  struct Derivatives {
    NodeId itself = kNoNode;
    std::vector<NodeId> first, second;
  };
  struct ConstantTerm {
    std::vector<Coefficient> coefficients;
    Derivatives monomial;
    std::vector<double> rotated{};  ///< C_μV
    std::vector<double> unsure{};   ///< a bound of its error
  };
  /// A matrix or a row of it: the middles of entries, and bounds of what is beside them.
  struct RoundEntries {
    std::vector<double> middle, radius;
    [[nodiscard]] Interval at(std::size_t e) const;
  };

  void differentiate(Question& question);
  [[nodiscard]] bool rotate_coefficients(const SingularBases& bases);
  template <class NodeOf>
  [[nodiscard]] bool total(const Evaluation& values, const NodeOf& node, RoundEntries& sum) const;
  [[nodiscard]] bool find_rows(const std::vector<double>& radius);
  [[nodiscard]] Intervals combine(const SingularBases& bases, const Intervals& rows) const;
  void add_pairs(const SingularBases& bases, RotatedMatrix& result) const;
  /// Encloses a scale of a row.
  [[nodiscard]] Interval scale(const Evaluation& values, std::size_t row) const {
    return scales_.empty() ? point(1.0) : values.value(scales_[row].itself);
  }
  /// Encloses a derivative of the scale.
  [[nodiscard]] Interval scale(const Evaluation& values, std::size_t row,
                               std::vector<NodeId> Derivatives::*order, std::size_t number) const {
    return scales_.empty() ? Interval{} : values.value((scales_[row].*order)[number]);
  }

  const Question& q_;
  const std::size_t m_, n_;
  std::vector<std::size_t> variables_;  ///< on which A depends
  std::vector<ConstantTerm> terms_;
  std::vector<Derivatives> scales_;                 ///< by row; none: they are 1
  std::optional<Evaluation> at_middle_, over_box_;  ///< nullopt: there are too many derivatives

  // For one box: a = ΣC_μVμ.
  RoundEntries middle_;              ///< a at the middle
  std::vector<RoundEntries> first_;  ///< ∂_pa at the middle
  std::vector<Intervals> second_;    ///< ∂²_pqa over the box
  Intervals over_;                   ///< a over the box
  std::vector<Intervals> slope_;     ///< ∂_pa over the box
};

}  // namespace regulus::verifier
