// SPDX-License-Identifier: Apache-2.0
// Makes the problem of orthants.hpp from the bounds of a box.
#include <cmath>

#include "runtime/regularity/orthant_terms.hpp"

namespace regulus::detail {
namespace {

constexpr double kFactor = raise_factor(4 * kMaxOrder + 8);
/// For the sums of all products of a row.
constexpr double kManySums = raise_factor(std::size_t{1} << 14);

double sum_ru(double x) noexcept { return raise_ru(x, kFactor); }

/// T of one lane, and from it V ≥ (I − P)⁻¹V₀.
class Coupling {
 public:
  Coupling(ConstPointMatrix T, std::size_t n, std::size_t s, std::size_t lane) noexcept
      : T_(T), n_(n), s_(s), lane_(lane) {
    solve();
    known_ = is_bound();
  }

  [[nodiscard]] bool known() const noexcept { return known_; }
  [[nodiscard]] double V(std::size_t i, std::size_t j) const noexcept { return V_[i * s_ + j]; }

 private:
  [[nodiscard]] double at(std::size_t i, std::size_t j) const noexcept {
    return T_.at(i * (n_ + s_) + j, lane_);
  }

  /// Solves (I − P)V = V₀ without pivoting, then increases the result slightly.
  void solve() noexcept {
    double a[kMaxColumns * kMaxColumns];
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) a[i * n_ + j] = (i == j ? 1.0 : 0.0) - at(i, j);
      for (std::size_t j = 0; j < s_; ++j) V_[i * s_ + j] = at(i, n_ + j);
    }
    for (std::size_t k = 0; k < n_; ++k)
      for (std::size_t i = k + 1; i < n_; ++i) {
        const double factor = a[i * n_ + k] / a[k * n_ + k];
        for (std::size_t j = k; j < n_; ++j) a[i * n_ + j] -= factor * a[k * n_ + j];
        for (std::size_t j = 0; j < s_; ++j) V_[i * s_ + j] -= factor * V_[k * s_ + j];
      }
    for (std::size_t i = n_; i-- > 0;)
      for (std::size_t j = 0; j < s_; ++j) {
        double x = V_[i * s_ + j];
        for (std::size_t k = i + 1; k < n_; ++k) x -= a[i * n_ + k] * V_[k * s_ + j];
        V_[i * s_ + j] = x / a[i * n_ + i];
      }
    for (std::size_t e = 0; e < n_ * s_; ++e) V_[e] = V_[e] * (1.0 + 0x1p-30) + 0x1p-900;
  }

  /// Tests PV + V₀ ≤ V, and Pw < w for w = V·1: then ρ(P) < 1, (I − P)⁻¹ ≥ 0 and V ≥ (I − P)⁻¹V₀.
  [[nodiscard]] bool is_bound() const noexcept {
    double w[kMaxColumns] = {};
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = 0; j < s_; ++j) {
        double sum = at(i, n_ + j);
        for (std::size_t k = 0; k < n_; ++k) sum += at(i, k) * V(k, j);
        if (!(sum_ru(sum) <= V(i, j) && V(i, j) < HUGE_VAL)) return false;
        w[i] += V(i, j);
      }
    for (std::size_t i = 0; i < n_; ++i) {
      double sum = 0.0;
      for (std::size_t k = 0; k < n_; ++k) sum += at(i, k) * w[k];
      if (!(w[i] > 0.0 && sum_ru(sum) < w[i])) return false;
    }
    return true;
  }

  const ConstPointMatrix T_;
  const std::size_t n_, s_, lane_;
  double V_[kMaxColumns * kMaxOrthantRows];
  bool known_ = false;
};

/// Loads the scales, and S = M + QV. Returns false if S is not bounded.
bool load_slack(const OrthantTerms& terms, const Coupling& coupling, std::size_t n,
                OrthantProblem& p) noexcept {
  for (unsigned row = 0; row < p.rows; ++row)
    for (unsigned j = 0; j < p.rows; ++j) {
      double& slack = p.slack[row * p.rows + j];
      const double reach = p.reach[row * p.rows + j];
      double sum = terms.M(row, j) + 2.0 * kSecondOrderGamma * reach;
      for (unsigned k = 0; k < n; ++k) sum += terms.Q(row, k) * coupling.V(k, j);
      slack = raise_ru(sum, kManySums);
      if (!(slack < HUGE_VAL && reach < HUGE_VAL)) return false;
    }
  return true;
}

}  // namespace

LaneMask SecondOrderBounds::certain_by_orthants(const SecondOrderInput& input, ConstPointMatrix T,
                                                ConstPointVector guess, LaneMask lanes,
                                                unsigned halvings,
                                                OrthantCell& hint) const noexcept {
  using Products = OrthantTerms::Products;
  const std::size_t n = plan_.columns_of_A;
  if (plan_.slots == 0 || plan_.slots > kMaxOrthantRows) return 0;
  if (lists_.row_variables() > kMaxOrthantForms) return 0;
  LaneMask certain = 0;
  OrthantProblem problem;
  for_each_lane(lanes, [&](std::size_t lane) {
    const Coupling coupling(T, n, plan_.slots, lane);
    if (!coupling.known()) return;
    for (unsigned row = 0; row < plan_.slots; ++row) {
      const double scale = guess.at(n + row, lane);
      problem.scale[row] = scale > 0x1p-100 && scale < 0x1p100 ? scale : 1.0;
    }
    OrthantTerms terms(plan_, input, work_, T, lane, problem);
    const auto load = [&](Products products) {
      return terms.load(products) && load_slack(terms, coupling, n, problem);
    };
    if (!load(Products::kBounded)) return;
    bool empty = certain_orthants_empty(problem, hint);
    if (!empty && halvings != 0 && load(Products::kForms))
      empty = certain_orthants_empty(problem, hint, halvings);
    if (empty) certain |= 1U << lane;
  });
  return certain;
}

}  // namespace regulus::detail
