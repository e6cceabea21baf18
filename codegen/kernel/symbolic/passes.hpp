// SPDX-License-Identifier: GPL-3.0-or-later
// The rewriting passes. Each returns the same function of the same variables, wherever the original
// is defined; each is in the file of its name.
#pragma once

#include <functional>
#include <optional>

#include "codegen/kernel/symbolic/polynomial.hpp"

namespace regulus::detail {

/// One coefficient as an expression: terms of the same magnitude are added before they are
/// multiplied, 9*(k_1_1 - k_1_2) + 12*(k_1_3 + k_1_4), so that the sums of K's entries come first
/// and are common to many coefficients.
///
/// Ensures   if two coefficients differ only in sign, one is −1 times the form of the other.
[[nodiscard]] Expression coefficient(const Polynomial& p, const AtomTable& atoms, Group group);

/// A product of variable atoms as an expression.
[[nodiscard]] Expression monomial(const AtomProduct& variables, const AtomTable& atoms);

/// Σ coefficient·monomial, each monomial once: form 2 of the paper.
/// Source    Merlet, T-RO 2007, §III-B1.
[[nodiscard]] Expression collect(const Polynomial& p, const AtomTable& atoms);

/// True if some atom is in two monomials, so that Horner's form differs from the collected one.
[[nodiscard]] bool can_nest(const Polynomial& p);

enum class HornerOrder {
  kMostFrequent,    ///< the atom in most monomials is taken out first
  kVariablesFirst,  ///< variables before functions of them, then by frequency
};

struct HornerOptions {
  HornerOrder order = HornerOrder::kMostFrequent;
  bool factor = true;            ///< look for (q + s)·t in q·t + s·t
  bool complete_squares = true;  ///< a·t² + b·t → a·(t + b/2a)² − b²/4a
};

/// Returns the nested form: takes an atom out of all monomials that contain it, and repeats this in
/// its cofactor and in the rest. Ties go to the atom that comes first in AtomTable::precedes.
[[nodiscard]] Expression horner(const Polynomial& p, const AtomTable& atoms,
                                const HornerOptions& options = {});

/// p = factor·rest, if all coefficients of p are rational multiples of one sum of K's entries.
struct CommonFactor {
  Polynomial factor;
  Polynomial rest;
};
[[nodiscard]] std::optional<CommonFactor> common_coefficient(const Polynomial& p);

/// outer·q + r as a product, if q divides r or r divides q.
/// Ensures   outer·q + r = first·second.
struct Factored {
  Polynomial first;
  Polynomial second;
};
[[nodiscard]] std::optional<Factored> factor_split(const Polynomial& outer, const Polynomial& q,
                                                   const Polynomial& r);

struct TrigonometricOptions {
  bool sums = true;            ///< cos a cos b − sin a sin b → cos(a + b), and its relatives
  bool double_angles = false;  ///< sin a cos a → sin(2a)/2, cos²a − sin²a → cos 2a
};

/// Reduces the number of sines and cosines: sin² and cos² of one angle are expressed by cos² alone,
/// products over pairs of angles by sums and differences. `simplify` gives the form of a new
/// argument.
[[nodiscard]] Polynomial merge_angles(const Polynomial& p, AtomTable& atoms, Expander& expander,
                                      const std::function<Expression(const Expression&)>& simplify,
                                      const TrigonometricOptions& options);

}  // namespace regulus::detail
