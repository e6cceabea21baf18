// SPDX-License-Identifier: Apache-2.0
// Lists of configurations at the places of a table for Coq: Solutions.v has their proof.
#pragma once

#include <string>

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Returns the theorem about the lists at the places of a table, with its file. `first` becomes the
/// question of the first one. Throws Rejection if it is no such certificate; Unfinished if a place has
/// no proof, or if there is no theorem about such places.
///
/// Requires: the first line has been read.
[[nodiscard]] std::string places_theorem(Lines& lines, Question& first);

}  // namespace regulus::verifier
