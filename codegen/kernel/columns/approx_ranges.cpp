// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/columns/approx_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "codegen/kernel/symbolic/lowering.hpp"

namespace regulus::detail {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Program program_of(const Expression& e, const std::vector<std::string>& names) {
  Lowering lowering(names, {});
  lowering.output(e);
  return std::move(lowering).finish();
}

ApproxRange constant_range(double value) {
  ApproxRange range;
  for (std::size_t l = 0; l < kLanes; ++l) range.lo[l] = range.hi[l] = value;
  return range;
}

void add_range(ApproxRange& sum, const ApproxRange& x) {
  for (std::size_t l = 0; l < kLanes; ++l) sum.lo[l] += x.lo[l], sum.hi[l] += x.hi[l];
}

ApproxRange times(const ApproxRange& x, const ApproxRange& y) {
  ApproxRange product;
  for (std::size_t l = 0; l < kLanes; ++l) {
    const double a = x.lo[l] * y.lo[l], b = x.lo[l] * y.hi[l];
    const double c = x.hi[l] * y.lo[l], d = x.hi[l] * y.hi[l];
    product.lo[l] = std::min(std::min(a, b), std::min(c, d));
    product.hi[l] = std::max(std::max(a, b), std::max(c, d));
  }
  return product;
}

ApproxRange raised(const ApproxRange& x, int exponent) {
  ApproxRange result = constant_range(1);
  for (int i = 0; i < exponent; ++i) result = times(result, x);
  if (exponent % 2 == 0)
    for (std::size_t l = 0; l < kLanes; ++l) {
      const double a = std::pow(x.lo[l], exponent), b = std::pow(x.hi[l], exponent);
      result.lo[l] = x.lo[l] <= 0 && x.hi[l] >= 0 ? 0.0 : std::min(a, b);
    }
  return result;
}

}  // namespace

AtomRanges::AtomRanges(const AtomTable& atoms, const std::vector<std::string>& variables)
    : atoms_(atoms.variable_atoms()) {
  for (std::size_t a = 0; a < atoms_; ++a) {
    programs_.push_back(program_of(atoms.variable_expression(static_cast<Atom>(a)), variables));
    known_.push_back(convert_constants(programs_.back(), arithmetic_));
  }
}

ApproxRanges AtomRanges::over(const std::vector<std::vector<Interval>>& boxes) {
  ApproxRanges ranges(atoms_);
  std::vector<Interval> box(boxes.size());
  for (std::size_t l = 0; l < kLanes; ++l) {
    for (std::size_t v = 0; v < box.size(); ++v) box[v] = boxes[v][l];
    for (std::size_t a = 0; a < atoms_; ++a) {
      arithmetic_.clear();
      values_.resize(programs_[a].nodes.size());
      run<IntervalArithmetic, Interval>(programs_[a], known_[a], box, {}, values_, arithmetic_);
      const Interval x = values_[programs_[a].outputs[0]];
      ranges[a].lo[l] = arithmetic_.undefined() ? kNaN : x.lo;
      ranges[a].hi[l] = arithmetic_.undefined() ? kNaN : x.hi;
    }
  }
  return ranges;
}

ApproxValues approx_coefficient_values(const AtomTable& atoms, std::size_t points) {
  ApproxValues values(atoms.coefficient_atoms());
  IntervalArithmetic arithmetic;
  for (std::size_t a = points; a < values.size(); ++a) {
    const Program program = program_of(atoms.coefficient_expression(static_cast<Atom>(a)), {});
    arithmetic.clear();
    const Interval x = evaluate<IntervalArithmetic, Interval>(program, {}, {}, arithmetic)[0];
    values[a] = arithmetic.undefined() ? kNaN : mid(x);
  }
  return values;
}

NestedRange::NestedRange(const Polynomial& p, const AtomTable& atoms, const ApproxValues& fixed,
                         const ApproxValues& coefficients)
    : forms_(1) {
  static_cast<void>(add_form(terms_of(p, fixed, coefficients), atoms));
}

NestedRange::Terms NestedRange::terms_of(const Polynomial& p, const ApproxValues& fixed,
                                         const ApproxValues& coefficients) {
  std::map<AtomProduct, std::vector<Constant>> grouped;
  for (const PolynomialTerm& term : p.terms()) {
    Constant constant{kNoPoint, cln::double_approx(term.factor)};
    for (const Atom a : term.monomial.coefficients) {
      if (coefficients[a])
        constant.factor *= *coefficients[a];
      else
        constant.point = a;
    }
    AtomProduct left;
    for (const Atom a : term.monomial.variables) {
      if (a < fixed.size() && fixed[a])
        constant.factor *= *fixed[a];
      else
        left.push_back(a);
    }
    grouped[left].push_back(constant);
  }
  Terms terms;
  for (auto& [product, coefficient] : grouped) terms.push_back({product, std::move(coefficient)});
  return terms;
}

/// Takes the atom that is in most terms out of them, as horner does.
std::size_t NestedRange::add_form(Terms terms, const AtomTable& atoms) {
  if (terms.empty()) return 0;
  const std::size_t here = forms_.size();
  forms_.emplace_back();
  std::map<Atom, int> counts;
  for (const Term& term : terms)
    for (std::size_t i = 0; i < term.atoms.size(); ++i)
      if (i == 0 || term.atoms[i] != term.atoms[i - 1]) ++counts[term.atoms[i]];
  const auto most = std::max_element(counts.begin(), counts.end(), [&](auto& a, auto& b) {
    return a.second != b.second ? a.second < b.second : atoms.precedes(b.first, a.first);
  });
  if (most == counts.end() || most->second < 2) {
    forms_[here].terms = std::move(terms);
    return here;
  }
  const Atom atom = most->first;
  int least = 0;
  for (const Term& term : terms) {
    const int exponent = exponent_of(term.atoms, atom);
    if (exponent > 0 && (least == 0 || exponent < least)) least = exponent;
  }
  const AtomProduct outer(static_cast<std::size_t>(least), atom);
  Terms inner, rest;
  for (Term& term : terms) {
    AtomProduct quotient;
    const bool divisible = divide(term.atoms, outer, quotient);
    if (divisible) term.atoms = std::move(quotient);
    (divisible ? inner : rest).push_back(std::move(term));
  }
  forms_[here].atom = atom;
  forms_[here].exponent = least;
  const std::size_t inner_form = add_form(std::move(inner), atoms);
  const std::size_t rest_form = add_form(std::move(rest), atoms);
  forms_[here].inner = inner_form;
  forms_[here].rest = rest_form;
  return here;
}

ApproxRange NestedRange::over(const ApproxRanges& atoms, const LaneValues* row_of_K) const {
  return forms_.size() > 1 ? over(1, atoms, row_of_K) : ApproxRange();
}

ApproxRange NestedRange::over(std::size_t form, const ApproxRanges& atoms,
                              const LaneValues* row_of_K) const {
  const Form& f = forms_[form];
  if (f.inner != 0) {
    const ApproxRange& atom = atoms[f.atom];
    ApproxRange sum =
        times(f.exponent == 1 ? atom : raised(atom, f.exponent), over(f.inner, atoms, row_of_K));
    if (f.rest != 0) add_range(sum, over(f.rest, atoms, row_of_K));
    return sum;
  }
  ApproxRange sum;
  for (const Term& term : f.terms) {
    ApproxRange x;
    for (const Constant& c : term.coefficient)
      for (std::size_t l = 0; l < kLanes; ++l)
        x.lo[l] += c.factor * (c.point == kNoPoint ? 1.0 : row_of_K[c.point][l]);
    x.hi = x.lo;
    for (std::size_t i = 0; i < term.atoms.size();) {
      const int exponent = exponent_of(term.atoms, term.atoms[i]);
      const ApproxRange& atom = atoms[term.atoms[i]];
      x = times(x, exponent == 1 ? atom : raised(atom, exponent));
      i += static_cast<std::size_t>(exponent);
    }
    add_range(sum, x);
  }
  return sum;
}

}  // namespace regulus::detail
