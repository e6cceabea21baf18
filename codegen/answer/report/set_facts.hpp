// SPDX-License-Identifier: GPL-3.0-or-later
// The set that a claim is about: poses, constraints, and values of the uncertain quantities.
#pragma once

#include <vector>

#include "codegen/answer/facts.hpp"
#include "codegen/question/engine/search_subject.hpp"

namespace regulus::detail {

/// The set of a request, before any search.
struct AskedSet {
  SearchSubject subject;
  std::vector<Variable> exact;  ///< in the order of the labels
};

/// The set of a motion along way-points lacks the poses: the file has them.
///
/// Throws    InputError if a range has no certain value.
[[nodiscard]] AskedSet set_of(const Request& request);

/// Tells the poses to people: the ranges, what the motion gives the other pose parameters, and the
/// constraints.
void say_poses(const SearchSubject& subject, const Request& request, Facts& facts);
/// Tells people the constraints, or the number of those that are long.
void say_constraints(const Motion& motion, Facts& facts);
/// Tells people that poses out of reach are left out, if they are.
void say_where(const SearchSubject& subject, Facts& facts);
void say_uncertain(const SearchSubject& subject, Facts& facts);
/// Tells people the same while those quantities grow that are uncertain in `grown` alone.
void say_growing(const SearchSubject& before, const SearchSubject& grown, Facts& facts);

/// Tells people the whole set of a request whose motion does not follow way-points.
void say_set(const Request& request, Facts& facts);

/// Returns "z = 475 mm": of a pose parameter at one value; `value`: a constant of the model.
[[nodiscard]] std::string fixed_text(const PoseParameter& parameter, const GiNaC::ex& value);

}  // namespace regulus::detail
