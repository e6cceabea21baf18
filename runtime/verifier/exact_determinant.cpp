// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/exact_determinant.hpp"

#include <algorithm>

namespace regulus::verifier {
namespace {

// FORMAT.md, "Limits", documents these.
constexpr std::uint64_t kProductsInFullForm = 1 << 21;
constexpr std::uint64_t kProductsInPlainForm = 1 << 19;
constexpr std::size_t kMostTermsOfForm = 2000;  ///< that are evaluated over boxes
constexpr std::size_t kMostTermsOfExtremum = 200;

/// Returns the variable of a polynomial that has only one.
std::optional<std::size_t> only_variable(const Algebra& algebra, const Polynomial& p, int& number) {
  number = -1;
  for (const auto& [powers, factor] : p.terms())
    for (const auto& [atom, exponent] : powers) {
      if ((number >= 0 && number != atom) || exponent < 0 ||
          algebra.atom(atom).kind != Atom::Kind::kVariable)
        return std::nullopt;
      number = atom;
    }
  if (number < 0) return std::nullopt;
  return std::size_t(algebra.atom(number).number);
}

}  // namespace

ExactDeterminant::ExactDeterminant(Question& question, const Variety& variety,
                                   const std::vector<NodeId>& matrix, long max_bits)
    : q_(question),
      variety_(variety),
      max_bits_(max_bits),
      bounds_(question),
      alpha_(exact_value(question.graph, question.alpha)) {
  const std::vector<NodeId> none;
  AlgebraBudget of_plain(kProductsInPlainForm), of_full(kProductsInFullForm);
  try {
    Algebra plain(q_.graph, none, Algebra::Form::kPlain, of_plain);
    plain_ = form_of(plain, matrix);
  } catch (const TooLarge&) {
    plain_.reset();
  }
  try {
    Algebra full(q_.graph, none, Algebra::Form::kFull, of_full);
    std::vector<NodeId> roots = matrix;
    roots.insert(roots.end(), q_.scale.begin(), q_.scale.end());
    full.find_units(roots);
    full_ = form_of(full, matrix);
  } catch (const TooLarge& why) {
    full_.reset();
    obstacle_ = why.what();
  }
}

std::unique_ptr<ExactDeterminant::Form> ExactDeterminant::form_of(
    Algebra& algebra, const std::vector<NodeId>& matrix) {
  Polynomial p = algebra.determinant(matrix, q_.columns);
  if (q_.has_threshold)
    for (const NodeId scale : q_.scale) p = algebra.product(p, algebra.of(scale));
  if (algebra.form() == Algebra::Form::kFull) p = algebra.split_functions(p);
  vanishes_ = vanishes_ || algebra.vanishes(p);
  int number = -1;
  if (const auto variable = only_variable(algebra, p, number))
    if (polynomial_.set(p, number)) only_ = variable;
  if (vanishes_ || p.terms().size() > kMostTermsOfForm) return nullptr;
  if (algebra.form() == Algebra::Form::kFull) reduce_by_constraints(algebra, p);
  has_few_terms_ = p.terms().size() <= kMostTermsOfExtremum;
  return std::make_unique<Form>(q_, algebra.expression(p));
}

/// Finds, for each constraint, the λ that leaves the fewest terms.
void ExactDeterminant::reduce_by_constraints(Algebra& algebra, const Polynomial& determinant) try {
  const Polynomial::Terms& terms = determinant.terms();
  for (const NodeId constraint : q_.constraints) {
    const Polynomial h = algebra.of(constraint);
    std::optional<Polynomial> best;
    bool from_below = false;
    for (const auto& [powers, factor] : h.terms()) {
      const auto like = terms.find(powers);
      if (like == terms.end() || powers.empty()) continue;
      const Rational lambda = like->second * Rational(-1) / factor;
      Polynomial left = determinant;
      left.add(h.scaled(lambda));
      if (left.terms().size() >= (best ? *best : determinant).terms().size()) continue;
      best = std::move(left);
      from_below = lambda.sign() > 0;
    }
    if (!best) continue;
    reduced_.push_back({std::make_unique<Form>(q_, algebra.expression(*best)), from_below});
  }
} catch (const TooLarge&) {
  // The reduction keeps its present state, and the other tests continue.
}

bool ExactDeterminant::exceeds_within_constraints(const Box& box) {
  for (const Reduced& reduced : reduced_) {
    if (!reduced.form->natural.run(box)) continue;
    const Interval g = reduced.form->natural.value(reduced.form->root);
    if (reduced.from_below ? g.lo > variety_.alpha.hi : g.hi < -variety_.alpha.hi) return true;
  }
  return false;
}

bool ExactDeterminant::exceeds_threshold(const Box& box) {
  if (plain_ && exceeds_naturally(*plain_, box)) return true;
  if (full_ && exceeds_naturally(*full_, box)) return true;
  if (exceeds_within_constraints(box)) return true;
  if (only_ && exceeds_in_one_variable(box)) return true;
  return full_ && has_few_terms_ && exceeds_at_extremum(box);
}

bool ExactDeterminant::exceeds_naturally(Form& form, const Box& box) {
  if (!form.natural.run(box)) return false;
  return mig(form.natural.value(form.root)) > variety_.alpha.hi ||
         mig(form.natural.narrowed(form.root, box)) > variety_.alpha.hi;
}

/// Shows that neither p − α nor p + α has a root between the ends, which are exact.
bool ExactDeterminant::exceeds_in_one_variable(const Box& box) const {
  const std::size_t k = *only_;
  if (!alpha_) return false;
  const auto end = [](double x, double outer, const std::optional<Rational>& exact) {
    if (x == outer && exact) return *exact;
    return rational_of(x);
  };
  const Rational lo = end(box[k].lo, variety_.outer[k].lo, q_.ends[k].lo);
  const Rational hi = end(box[k].hi, variety_.outer[k].hi, q_.ends[k].hi);
  if ((hi - lo).sign() < 0) return true;  // outside the range, inside its enclosure
  Univariate below = polynomial_, above = polynomial_;
  below.subtract(*alpha_);
  above.subtract(*alpha_ * Rational(-1));
  const int sign = polynomial_.at(lo).sign();
  if (sign == 0 || (sign > 0 ? below : above).at(lo).sign() != sign) return false;
  return below.has_no_root(lo, hi) && above.has_no_root(lo, hi);
}

bool ExactDeterminant::exceeds_at_extremum(const Box& box) {
  return Extremum(variety_, bounds_, *full_, box, max_bits_).exceeds();
}

}  // namespace regulus::verifier
