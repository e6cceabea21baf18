// SPDX-License-Identifier: Apache-2.0
// Makes the cells of orthants.hpp from the bounds of a box.
#include "runtime/regularity/orthants.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "runtime/regularity/backend.hpp"
#include "runtime/regularity/second_order.hpp"

namespace regulus {
namespace {

constexpr unsigned kMaxOrthantCells = kMaxOrthantRows << (kMaxOrthantRows - 1);

constexpr double kFactor = raise_factor(4 * kMaxOrder + 8);

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
  [[nodiscard]] double Q(std::size_t i, std::size_t j) const noexcept { return at(n_ + i, j); }

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

/// Loads the forms and terms of a lane, row by row.
void load_terms(const SecondOrderPlan& plan, const SecondOrderInput& input,
                const SecondOrderWork& work, std::size_t lane, OrthantProblem& problem) noexcept {
  const unsigned s = plan.slots;
  unsigned forms = 0;
  for (unsigned row = 0; row < s; ++row) {
    problem.first_term[row] = problem.terms;
    for (unsigned g = 0; g < plan.groups; ++g) {
      const SecondOrderPlan::Group& group = plan.group[g];
      if (group.slot != row) continue;
      OrthantProblem::Term& term = problem.term[problem.terms++];
      term = {forms, forms + group.members.size(), 0.0};
      for (unsigned k = group.members.begin; k < group.members.end; ++k, ++forms) {
        term.weight = std::max(term.weight, input.radius.at(plan.row_variables[k].variable, lane));
        for (unsigned j = 0; j < s; ++j)
          problem.form[forms * s + j] = work.forms.x[point_at(k * s + j, lane)];
      }
    }
  }
  problem.first_term[s] = problem.terms;
}

double norm_ru(const OrthantProblem& problem, const OrthantProblem::Term& term,
               unsigned j) noexcept {
  const unsigned s = problem.rows;
  if (term.end - term.begin == 1) return std::fabs(problem.form[term.begin * s + j]);
  double squares = 0.0;
  for (unsigned k = term.begin; k < term.end; ++k)
    squares += problem.form[k * s + j] * problem.form[k * s + j];
  return sum_ru(std::sqrt(sum_ru(squares)));
}

/// Computes G_lj: for each term, the weight times the norm of its forms' j-th coefficients.
void bound_reach(OrthantProblem& problem) noexcept {
  const unsigned s = problem.rows;
  for (unsigned row = 0; row < s; ++row)
    for (unsigned j = 0; j < s; ++j) {
      double sum = 0.0;
      for (unsigned t = problem.first_term[row]; t < problem.first_term[row + 1]; ++t) {
        const OrthantProblem::Term& term = problem.term[t];
        sum += term.weight * norm_ru(problem, term, j);
      }
      problem.reach[row * s + j] = raise_ru(sum, raise_factor(kMaxOrthantForms));
    }
}

bool load(const SecondOrderPlan& plan, const SecondOrderInput& input, const SecondOrderWork& work,
          ConstPointMatrix T, ConstPointVector guess, std::size_t lane,
          OrthantProblem& problem) noexcept {
  const unsigned n = plan.columns_of_A, s = plan.slots;
  const Coupling coupling(T, n, s, lane);
  if (!coupling.known()) return false;
  problem.rows = s;
  problem.terms = 0;
  load_terms(plan, input, work, lane, problem);
  bound_reach(problem);
  for (unsigned i = 0; i < s; ++i) {
    const double scale = guess.at(n + i, lane);
    problem.scale[i] = scale > 0x1p-100 && scale < 0x1p100 ? scale : 1.0;
    for (unsigned j = 0; j < s; ++j) {
      double sum = work.moving.x[point_at(i * s + j, lane)] +
                   2.0 * kSecondOrderGamma * problem.reach[i * s + j];
      for (unsigned k = 0; k < n; ++k) sum += coupling.Q(i, k) * coupling.V(k, j);
      problem.slack[i * s + j] = sum_ru(sum);
      if (!(problem.slack[i * s + j] < HUGE_VAL && problem.reach[i * s + j] < HUGE_VAL))
        return false;
    }
  }
  return true;
}

}  // namespace

bool certain_orthants_empty(const OrthantProblem& problem, OrthantCell& hint) noexcept {
  const RegularityBackend& backend = regularity_backend();
  OrthantCell cells[kMaxOrthantCells];
  unsigned count = 0;
  for (unsigned first = 0; first < 1U << (problem.rows - 1); first += kLanes) {
    unsigned possible[kMaxOrthantRows];
    backend.possible_rows(problem, first, possible);
    for (unsigned lane = 0; lane < kLanes && first + lane < 1U << (problem.rows - 1); ++lane)
      for (unsigned row = 0; row < problem.rows; ++row)
        if ((possible[row] >> lane & 1U) != 0) cells[count++] = {first + lane, row};
  }
  const auto is_hint = [&hint](const OrthantCell& cell) {
    return cell.orthant == hint.orthant && cell.fixed == hint.fixed;
  };
  if (count == 0) return true;
  std::iter_swap(cells, std::find_if(cells, cells + count - 1, is_hint));
  // The last group of eight is completed with copies.
  for (unsigned end = count; end % kLanes != 0; ++end) cells[end] = cells[0];
  for (unsigned first = 0; first < count; first += kLanes) {
    const unsigned remaining = backend.remaining_cells(problem, cells + first);
    if (remaining == 0) continue;
    hint = cells[first + static_cast<unsigned>(std::countr_zero(remaining))];
    return false;
  }
  return true;
}

LaneMask SecondOrderBounds::certain_by_orthants(const SecondOrderInput& input, ConstPointMatrix T,
                                                ConstPointVector guess, LaneMask lanes,
                                                OrthantCell& hint) const noexcept {
  if (plan_.slots == 0 || plan_.slots > kMaxOrthantRows) return 0;
  if (lists_.row_variables() > kMaxOrthantForms) return 0;
  LaneMask certain = 0;
  OrthantProblem problem;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    if (has_lane(lanes, lane) && load(plan_, input, work_, T, guess, lane, problem) &&
        certain_orthants_empty(problem, hint))
      certain |= 1U << lane;
  return certain;
}

}  // namespace regulus
