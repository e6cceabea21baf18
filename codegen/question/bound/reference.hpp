// SPDX-License-Identifier: GPL-3.0-or-later
// The choices that every bracket of a component makes: its reference, its first upper end, and the
// bound that a value of r means.
#pragma once

#include <optional>
#include <vector>

#include "codegen/question/bound/bound_run.hpp"
#include "codegen/question/margin/margin_question.hpp"
#include "codegen/question/quantity/bordered.hpp"

namespace regulus::detail {

/// The y of question/quantity/bordered.hpp.
struct Reference {
  double approx = 0;                ///< its shortest decimal is y
  std::optional<double> sampled{};  ///< a value of r at which B is singular somewhere, roughly

  [[nodiscard]] GiNaC::ex value() const;
};

/// Chooses y below the largest of some values of the component, so that the bound is y + 1/R with
/// R > 0. A magnitude below `least` counts as 0 if that is proved of it: what is sampled is not less,
/// for no test can tell 0 from the rounding of the samples.
[[nodiscard]] Reference choose_reference(const Component& component,
                                         const std::vector<double>& values, double least);

/// Returns the question of a bracket from 0 to just above `sampled`, or without an upper end.
[[nodiscard]] MarginQuestion question_beyond(const Bordered& bordered,
                                             const std::optional<double>& sampled);

/// Returns the bound on q that regularity up to a value of r means.
[[nodiscard]] GiNaC::ex bound_at(const Bordered& bordered, const Component& component,
                                 const MarginValue& value);

/// True if the component is 0 wherever it has a value: a row that no twist of the set moves, such as
/// a constraint's, has the speed 0 as an expression.
[[nodiscard]] bool is_zero_where_defined(const Bordered& bordered, const Component& component);
/// Sets both ends to 0, attained at every pose.
void set_zero(ComponentBound& bound);

/// Returns (proved − attained)/larger of the two; nullopt unless there are both.
[[nodiscard]] std::optional<double> relative_gap(const ComponentBound* attained,
                                                 const ComponentBound* proved);

}  // namespace regulus::detail
