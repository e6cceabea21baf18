// SPDX-License-Identifier: Apache-2.0
// Makes the problem of orthants.hpp from the bounds of a box.
#include <algorithm>
#include <cmath>

#include "runtime/regularity/orthants.hpp"
#include "runtime/regularity/second_order.hpp"

namespace regulus {
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

enum class Products {
  kBounded,  ///< in S
  kForms,    ///< their first part in forms, the rest in S
};

/// Makes the problem of one lane from the numbers of the bounds.
class Loader {
 public:
  Loader(const SecondOrderPlan& plan, const SecondOrderInput& input, const SecondOrderWork& work,
         ConstPointMatrix T, std::size_t lane, OrthantProblem& problem) noexcept
      : plan_(plan),
        in_(input),
        w_(work),
        T_(T),
        lane_(lane),
        p_(problem),
        n_(plan.columns_of_A),
        s_(plan.slots) {}

  /// Returns false if there are too many forms, or S is not bounded.
  bool load(const Coupling& coupling, ConstPointVector guess, Products products) noexcept {
    p_.rows = s_;
    p_.terms = forms_ = 0;
    for (unsigned row = 0; row < s_; ++row) {
      p_.first_term[row] = p_.terms;
      load_Q(row, products);
      load_quantities(row);
      if (products == Products::kForms && !load_products(row)) return false;
    }
    p_.first_term[s_] = p_.terms;
    bound_reach(p_);
    for (unsigned row = 0; row < s_; ++row) {
      const double scale = guess.at(n_ + row, lane_);
      p_.scale[row] = scale > 0x1p-100 && scale < 0x1p100 ? scale : 1.0;
      if (!load_slack(coupling, row)) return false;
    }
    return true;
  }

 private:
  using Group = SecondOrderPlan::Group;
  using Term = OrthantProblem::Term;

  [[nodiscard]] double at(const PointArray& array, std::size_t e) const noexcept {
    return array.x[point_at(e, lane_)];
  }
  [[nodiscard]] double P(unsigned i, unsigned j) const noexcept {
    return T_.at(i * (n_ + s_) + j, lane_);
  }
  [[nodiscard]] double K(unsigned i, unsigned slot) const noexcept {
    return in_.K.at(i * plan_.rows + plan_.touched[slot], lane_);
  }

  /// Sets M, and Q without products of the quantities of the row if these are forms.
  void load_Q(unsigned row, Products products) noexcept {
    for (unsigned j = 0; j < s_; ++j) M_[row][j] = at(w_.moving, row * s_ + j);
    for (unsigned j = 0; j < n_; ++j) {
      double sum = at(w_.rest, row * n_ + j);
      if (products == Products::kBounded) sum += at(w_.same_row, row * n_ + j);
      for (unsigned i = 0; i < n_; ++i)
        sum += (at(w_.weight, row * n_ + i) + at(w_.weight_of_g, row * n_ + i)) * P(i, j);
      Q_[row][j] = sum;
    }
  }

  /// Loads the terms of first order.
  void load_quantities(unsigned row) noexcept {
    for (unsigned g = 0; g < plan_.groups; ++g) {
      const Group& group = plan_.group[g];
      if (group.slot != row) continue;
      p_.term[p_.terms++] = {forms_, forms_ + group.members.size(), range(group)};
      for (unsigned k = group.members.begin; k < group.members.end; ++k, ++forms_)
        for (unsigned j = 0; j < s_; ++j) p_.form[forms_ * s_ + j] = at(w_.forms, k * s_ + j);
    }
  }

  [[nodiscard]] double range(const Group& group) const noexcept {
    double widest = 0.0;
    for (unsigned k = group.members.begin; k < group.members.end; ++k)
      widest = std::max(widest, in_.radius.at(plan_.row_variables[k].variable, lane_));
    return widest;
  }

  /// Loads a term for each two groups of the row that have a product.
  bool load_products(unsigned row) noexcept {
    for (unsigned a = 0; a < plan_.groups; ++a) {
      if (plan_.group[a].slot != row) continue;
      for (unsigned b = 0; b <= a; ++b)
        if (plan_.group[b].slot == row && !load_term(row, plan_.group[a], plan_.group[b]))
          return false;
    }
    return true;
  }

  /// Loads what the products of two groups of the row add to f: nothing if they have none.
  bool load_term(unsigned row, const Group& a, const Group& b) noexcept {
    const bool same = &a == &b;
    Term term{forms_, forms_, sum_ru(range(a) * range(b))};
    // Within a ball x_jk is listed for j ≤ k: ½‖x‖_F is at most √½ times the norm of the list.
    if (same) term.weight *= a.members.size() == 1 ? 0.5 : 0x1.6a09e7p-1;
    term.is_matrix = !same && a.members.size() == 3 && b.members.size() == 3;
    if (!load_forms(row, a, b, term)) return false;
    if (forms_ == term.begin) return true;
    if (p_.terms == kMaxOrthantForms) return false;
    term.end = forms_;
    p_.term[p_.terms++] = term;
    return true;
  }

  bool load_forms(unsigned row, const Group& a, const Group& b, const Term& term) noexcept {
    bool has_products = false, fits = true;
    const auto load = [&](unsigned i, unsigned j, const PlanRange& entries) {
      const unsigned form = term.is_matrix ? term.begin + 3 * i + j : forms_++;
      if (term.is_matrix && !has_products) fits = clear_matrix();
      has_products = true;
      fits = fits && form < kMaxOrthantForms;
      if (fits) load_form(row, entries, term.weight, form);
    };
    visit_products(a, b, load);
    if (&a != &b)
      visit_products(b, a, [&](unsigned j, unsigned i, const PlanRange& e) { load(i, j, e); });
    return fits;
  }

  /// Appends the forms of a matrix, all zero.
  bool clear_matrix() noexcept {
    if (forms_ + 9 > kMaxOrthantForms) return false;
    std::fill(p_.form + forms_ * s_, p_.form + (forms_ + 9) * s_, 0.0);
    forms_ += 9;
    return true;
  }

  /// Calls visit(i, j, entries of H) for the products that are listed with the i-th quantity of `a`
  /// and have the j-th of `b`.
  template <typename Visit>
  void visit_products(const Group& a, const Group& b, Visit&& visit) const noexcept {
    for (unsigned k = a.members.begin; k < a.members.end; ++k) {
      const PlanRange& products = plan_.row_variables[k].same_row;
      for (unsigned o = products.begin; o < products.end; ++o)
        for (unsigned j = b.members.begin; j < b.members.end; ++j)
          if (plan_.row_variables[j].variable == plan_.same_rows[o].variable)
            visit(k - a.members.begin, j - b.members.begin, plan_.same_rows[o].second);
    }
  }

  /// Loads c = H̄ᵀK₀, and adds the rest of the product to M and Q.
  void load_form(unsigned row, const PlanRange& entries, double weight, unsigned at_form) noexcept {
    double* const form = p_.form + at_form * s_;
    std::fill(form, form + s_, 0.0);
    for (unsigned e = entries.begin; e < entries.end; ++e) {
      const unsigned i = plan_.entries[e].column;
      const double lo = in_.row_second.lower(plan_.entries[e].at, lane_);
      const double hi = in_.row_second.upper(plan_.entries[e].at, lane_);
      const double middle = 0.5 * lo + 0.5 * hi, magnitude = std::fabs(middle);
      const double radius = std::max(hi - middle, middle - lo);
      for (unsigned j = 0; j < s_; ++j) {
        form[j] += middle * K(i, j);
        M_[row][j] += weight * magnitude *
                      (at(w_.sum_DK, i * s_ + j) + kSecondOrderGamma * std::fabs(K(i, j)));
      }
      for (unsigned j = 0; j < n_; ++j) Q_[row][j] += weight * magnitude * P(i, j);
      Q_[row][i] += weight * radius;
    }
  }

  bool load_slack(const Coupling& coupling, unsigned row) noexcept {
    for (unsigned j = 0; j < s_; ++j) {
      double sum = M_[row][j] + 2.0 * kSecondOrderGamma * p_.reach[row * s_ + j];
      for (unsigned k = 0; k < n_; ++k) sum += Q_[row][k] * coupling.V(k, j);
      p_.slack[row * s_ + j] = raise_ru(sum, kManySums);
      if (!(p_.slack[row * s_ + j] < HUGE_VAL && p_.reach[row * s_ + j] < HUGE_VAL)) return false;
    }
    return true;
  }

  const SecondOrderPlan& plan_;
  const SecondOrderInput& in_;
  const SecondOrderWork& w_;
  const ConstPointMatrix T_;
  const std::size_t lane_;
  OrthantProblem& p_;
  const unsigned n_, s_;
  unsigned forms_ = 0;
  double M_[kMaxOrthantRows][kMaxOrthantRows], Q_[kMaxOrthantRows][kMaxColumns];
};

}  // namespace

LaneMask SecondOrderBounds::certain_by_orthants(const SecondOrderInput& input, ConstPointMatrix T,
                                                ConstPointVector guess, LaneMask lanes,
                                                unsigned halvings,
                                                OrthantCell& hint) const noexcept {
  if (plan_.slots == 0 || plan_.slots > kMaxOrthantRows) return 0;
  if (lists_.row_variables() > kMaxOrthantForms) return 0;
  LaneMask certain = 0;
  OrthantProblem problem;
  for_each_lane(lanes, [&](std::size_t lane) {
    const Coupling coupling(T, plan_.columns_of_A, plan_.slots, lane);
    if (!coupling.known()) return;
    Loader loader(plan_, input, work_, T, lane, problem);
    if (!loader.load(coupling, guess, Products::kBounded)) return;
    bool empty = certain_orthants_empty(problem, hint);
    if (!empty && halvings != 0 && loader.load(coupling, guess, Products::kForms))
      empty = certain_orthants_empty(problem, hint, halvings);
    if (empty) certain |= 1U << lane;
  });
  return certain;
}

}  // namespace regulus
