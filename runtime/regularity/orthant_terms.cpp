// SPDX-License-Identifier: Apache-2.0
#include "runtime/regularity/orthant_terms.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::detail {
namespace {

constexpr double kReachFactor = raise_factor(kMaxOrthantForms);

/// Bounds the Euclidean norm of the j-th coefficients of `count` forms.
double coefficient_norm_ru(const OrthantProblem& problem, unsigned begin, unsigned count,
                           unsigned j) noexcept {
  const unsigned s = problem.rows;
  if (count == 1) return std::fabs(problem.form[begin * s + j]);
  double squares = 0.0;
  for (unsigned k = begin; k < begin + count; ++k)
    squares += problem.form[k * s + j] * problem.form[k * s + j];
  return raise_ru(std::sqrt(raise_ru(squares, kReachFactor)), kReachFactor);
}

/// Bounds what one term adds to G_lj.
double term_reach_ru(const OrthantProblem& problem, const OrthantProblem::Term& term,
                     unsigned j) noexcept {
  using Kind = OrthantProblem::Term::Kind;
  const unsigned y = term.begin + term.first, Z = y + term.second;
  double sum = 0.0;
  switch (term.kind) {
    case Kind::kRanges:
      for (unsigned k = term.begin; k < term.end; ++k)
        sum += std::fabs(problem.form[k * problem.rows + j]);
      return sum;
    case Kind::kBalls:
      return coefficient_norm_ru(problem, term.begin, term.first, j) +
             coefficient_norm_ru(problem, y, term.second, j) +
             coefficient_norm_ru(problem, Z, term.end - Z, j);
    default:
      return term.weight * coefficient_norm_ru(problem, term.begin, term.end - term.begin, j);
  }
}

}  // namespace

OrthantTerms::OrthantTerms(const SecondOrderPlan& plan, const SecondOrderInput& input,
                           const SecondOrderWork& work, ConstPointMatrix T, std::size_t lane,
                           OrthantProblem& problem) noexcept
    : plan_(plan),
      in_(input),
      w_(work),
      T_(T),
      lane_(lane),
      p_(problem),
      n_(plan.columns_of_A),
      s_(plan.slots) {}

bool OrthantTerms::load(Products products) noexcept {
  p_.rows = s_;
  p_.terms = forms_ = 0;
  for (unsigned row = 0; row < s_; ++row)
    if (!load_row(row, products)) return false;
  p_.first_term[s_] = p_.terms;
  bound_reach();
  return true;
}

bool OrthantTerms::load_row(unsigned row, Products products) noexcept {
  p_.first_term[row] = p_.terms;
  load_Q(row, products);
  list_groups(row);
  const bool forms = products == Products::kForms;
  if (forms) {
    pair_balls();
    choose_ends();
    if (!load_balls(row) || !load_ranges(row)) return false;
  }
  load_quantities();
  return !forms || load_products(row);
}

/// Sets M, and Q without products of the quantities of the row if these are forms.
void OrthantTerms::load_Q(unsigned row, Products products) noexcept {
  for (unsigned j = 0; j < s_; ++j) M_[row][j] = at(w_.moving, row * s_ + j);
  for (unsigned j = 0; j < n_; ++j) {
    double sum = at(w_.rest, row * n_ + j);
    if (products == Products::kBounded) sum += at(w_.same_row, row * n_ + j);
    for (unsigned i = 0; i < n_; ++i)
      sum += (at(w_.weight, row * n_ + i) + at(w_.weight_of_g, row * n_ + i)) * P(i, j);
    Q_[row][j] = sum;
  }
}

void OrthantTerms::list_groups(unsigned row) noexcept {
  group_count_ = 0;
  for (unsigned g = 0; g < plan_.groups; ++g) {
    if (plan_.group[g].slot != row) continue;
    role_[group_count_] = {};
    groups_[group_count_++] = g;
  }
}

/// Couples two balls that have products; each ball with one other.
void OrthantTerms::pair_balls() noexcept {
  const auto is_free = [&](unsigned g) {
    const unsigned size = group(g).members.size();
    return size > 1 && size <= kMaxOfBall && role_[g].kind == Role::Kind::kAlone;
  };
  for (unsigned a = 0; a < group_count_; ++a)
    for (unsigned b = 0; b < a && is_free(a); ++b) {
      if (!is_free(b) || !have_products(group(a), group(b))) continue;
      role_[a] = {Role::Kind::kFirstBall, b};
      role_[b] = {Role::Kind::kSecondBall, a};
    }
}

/// Chooses quantities whose ends are tried: those with most products.
void OrthantTerms::choose_ends() noexcept {
  for (unsigned ends = 0; ends < kMaxEndsTried; ++ends) {
    unsigned best = 0, most = 0;
    for (unsigned g = 0; g < group_count_; ++g)
      if (const unsigned count = count_partners(g); count > most) best = g, most = count;
    if (most == 0) break;
    role_[best].kind = Role::Kind::kEnd;
  }
  find_followers();
}

/// Returns how many quantities, no ends, have products with this one; 0 if it is an end or in a
/// ball.
unsigned OrthantTerms::count_partners(unsigned g) const noexcept {
  const auto is_free = [&](unsigned k) {
    return group(k).members.size() == 1 && role_[k].kind == Role::Kind::kAlone;
  };
  unsigned count = 0;
  for (unsigned k = 0; k < group_count_ && is_free(g); ++k)
    count += k != g && is_free(k) && have_products(group(g), group(k));
  return count;
}

void OrthantTerms::find_followers() noexcept {
  unsigned count = 0;
  for (unsigned g = 0; g < group_count_ && count < kMaxCoupled; ++g) {
    if (group(g).members.size() > 1 || role_[g].kind != Role::Kind::kAlone) continue;
    bool follows = false;
    for (unsigned k = 0; k < group_count_; ++k)
      follows = follows || (role_[k].kind == Role::Kind::kEnd && have_products(group(g), group(k)));
    if (follows) role_[g].kind = Role::Kind::kFollower, ++count;
  }
}

/// Returns true if a coupled term has the products of two groups.
bool OrthantTerms::is_covered(unsigned a, unsigned b) const noexcept {
  const Role &x = role_[a], &y = role_[b];
  if (x.kind == Role::Kind::kFirstBall || x.kind == Role::Kind::kSecondBall)
    return x.partner == b && a != b;
  return (x.kind == Role::Kind::kEnd && y.kind == Role::Kind::kFollower) ||
         (x.kind == Role::Kind::kFollower && y.kind == Role::Kind::kEnd);
}

bool OrthantTerms::load_balls(unsigned row) noexcept {
  for (unsigned g = 0; g < group_count_; ++g) {
    if (role_[g].kind != Role::Kind::kFirstBall) continue;
    const Group &first = group(g), &second = group(role_[g].partner);
    if (!begin_coupled(Term::Kind::kBalls, first.members.size(), second.members.size()))
      return false;
    load_scaled(first, p_.term[p_.terms].begin);
    load_scaled(second, p_.term[p_.terms].begin + first.members.size());
    load_coupling(row, first, 0, second, 0);
    ++p_.terms;
  }
  return true;
}

bool OrthantTerms::load_ranges(unsigned row) noexcept {
  unsigned ends[kMaxEndsTried], followers[kMaxCoupled], first = 0, second = 0;
  for (unsigned g = 0; g < group_count_; ++g) {
    if (role_[g].kind == Role::Kind::kEnd) ends[first++] = g;
    if (role_[g].kind == Role::Kind::kFollower) followers[second++] = g;
  }
  if (first == 0) return true;
  if (!begin_coupled(Term::Kind::kRanges, first, second)) return false;
  const unsigned x = p_.term[p_.terms].begin;
  for (unsigned i = 0; i < first; ++i) load_scaled(group(ends[i]), x + i);
  for (unsigned j = 0; j < second; ++j) {
    load_scaled(group(followers[j]), x + first + j);
    for (unsigned i = 0; i < first; ++i)
      load_coupling(row, group(ends[i]), i, group(followers[j]), j);
  }
  ++p_.terms;
  return true;
}

/// Begins the next term, with all forms 0.
bool OrthantTerms::begin_coupled(Term::Kind kind, unsigned first, unsigned second) noexcept {
  if (p_.terms == kMaxOrthantForms) return false;
  Term& term = p_.term[p_.terms];
  term = {forms_, 0, 1.0, kind, first, second};
  if (!append_zeros(first + second + first * second)) return false;
  term.end = forms_;
  return true;
}

/// Loads Δc for the quantities of a group. Its rounding is that of another sum of c_kᵀρ.
void OrthantTerms::load_scaled(const Group& group, unsigned at_form) noexcept {
  const double widest = range(group);
  for (unsigned k = group.members.begin; k < group.members.end; ++k, ++at_form)
    for (unsigned j = 0; j < s_; ++j) p_.form[at_form * s_ + j] = widest * at(w_.forms, k * s_ + j);
}

/// Loads the products of two groups into Z of the last term: members of `first` from column i on,
/// of `second` from row j on.
void OrthantTerms::load_coupling(unsigned row, const Group& first, unsigned i, const Group& second,
                                 unsigned j) noexcept {
  const Term& term = p_.term[p_.terms];
  const unsigned Z = term.begin + term.first + term.second;
  const double weight = raise_ru(range(first) * range(second), raise_factor(1));
  visit_products(first, second, [&](unsigned a, unsigned b, const PlanRange& entries) {
    const unsigned form = Z + (j + b) * term.first + i + a;
    load_form(row, entries, weight, form);
    for (unsigned k = 0; k < s_; ++k) p_.form[form * s_ + k] *= weight;
  });
}

/// Loads the terms of first order of the other groups.
void OrthantTerms::load_quantities() noexcept {
  for (unsigned g = 0; g < group_count_; ++g) {
    if (role_[g].kind != Role::Kind::kAlone) continue;
    const PlanRange& members = group(g).members;
    p_.term[p_.terms++] = {forms_, forms_ + members.size(), range(group(g))};
    for (unsigned k = members.begin; k < members.end; ++k, ++forms_)
      for (unsigned j = 0; j < s_; ++j) p_.form[forms_ * s_ + j] = at(w_.forms, k * s_ + j);
  }
}

double OrthantTerms::range(const Group& group) const noexcept {
  double widest = 0.0;
  for (unsigned k = group.members.begin; k < group.members.end; ++k)
    widest = std::max(widest, in_.radius.at(plan_.row_variables[k].variable, lane_));
  return widest;
}

/// Loads a term for each two groups of the row that have a product, but not in a coupled term.
bool OrthantTerms::load_products(unsigned row) noexcept {
  for (unsigned a = 0; a < group_count_; ++a)
    for (unsigned b = 0; b <= a; ++b)
      if (!is_covered(a, b) && !load_term(row, group(a), group(b))) return false;
  return true;
}

/// Loads what the products of two groups of the row add to f: nothing if they have none.
bool OrthantTerms::load_term(unsigned row, const Group& a, const Group& b) noexcept {
  const bool same = &a == &b;
  Term term{forms_, forms_, raise_ru(range(a) * range(b), raise_factor(1))};
  // Within a ball x_jk is listed for j ≤ k: ½‖x‖_F is at most √½ times the norm of the list.
  if (same) term.weight *= a.members.size() == 1 ? 0.5 : 0x1.6a09e7p-1;
  if (!same && a.members.size() == 3 && b.members.size() == 3) term.kind = Term::Kind::kMatrix;
  if (!load_forms(row, a, b, term)) return false;
  if (forms_ == term.begin) return true;
  if (p_.terms == kMaxOrthantForms) return false;
  term.end = forms_;
  p_.term[p_.terms++] = term;
  return true;
}

bool OrthantTerms::load_forms(unsigned row, const Group& a, const Group& b,
                              const Term& term) noexcept {
  if (!have_products(a, b)) return true;
  const bool is_matrix = term.kind == Term::Kind::kMatrix;
  bool fits = !is_matrix || append_zeros(9);
  visit_products(a, b, [&](unsigned i, unsigned j, const PlanRange& entries) {
    fits = fits && (is_matrix || append_zeros(1));
    if (fits) load_form(row, entries, term.weight, is_matrix ? term.begin + 3 * i + j : forms_ - 1);
  });
  return fits;
}

bool OrthantTerms::append_zeros(unsigned count) noexcept {
  if (forms_ + count > kMaxOrthantForms) return false;
  std::fill_n(p_.form + forms_ * s_, count * s_, 0.0);
  forms_ += count;
  return true;
}

bool OrthantTerms::have_products(const Group& a, const Group& b) const noexcept {
  bool found = false;
  visit_products(a, b, [&](unsigned, unsigned, const PlanRange&) { found = true; });
  return found;
}

/// Calls visit(i, j, entries of H) for each product of the i-th quantity of `a` and the j-th of `b`.
template <typename Visit>
void OrthantTerms::visit_products(const Group& a, const Group& b, Visit&& visit) const noexcept {
  visit_listed(a, b, visit);
  if (&a != &b)
    visit_listed(b, a, [&](unsigned j, unsigned i, const PlanRange& e) { visit(i, j, e); });
}

/// The same for the products that are listed with the quantity of `a`.
template <typename Visit>
void OrthantTerms::visit_listed(const Group& a, const Group& b, Visit&& visit) const noexcept {
  for (unsigned k = a.members.begin; k < a.members.end; ++k) {
    const PlanRange& products = plan_.row_variables[k].same_row;
    for (unsigned o = products.begin; o < products.end; ++o)
      for (unsigned j = b.members.begin; j < b.members.end; ++j)
        if (plan_.row_variables[j].variable == plan_.same_rows[o].variable)
          visit(k - a.members.begin, j - b.members.begin, plan_.same_rows[o].second);
  }
}

/// Loads c = H̄ᵀK₀, and adds the rest of the product to M and Q.
void OrthantTerms::load_form(unsigned row, const PlanRange& entries, double weight,
                             unsigned at_form) noexcept {
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
      M_[row][j] +=
          weight * magnitude * (at(w_.sum_DK, i * s_ + j) + kSecondOrderGamma * std::fabs(K(i, j)));
    }
    for (unsigned j = 0; j < n_; ++j) Q_[row][j] += weight * magnitude * P(i, j);
    Q_[row][i] += weight * radius;
  }
}

void OrthantTerms::bound_reach() noexcept {
  for (unsigned row = 0; row < s_; ++row)
    for (unsigned j = 0; j < s_; ++j) {
      double sum = 0.0;
      for (unsigned t = p_.first_term[row]; t < p_.first_term[row + 1]; ++t)
        sum += term_reach_ru(p_, p_.term[t], j);
      p_.reach[row * s_ + j] = raise_ru(sum, kReachFactor);
    }
}

}  // namespace regulus::detail
