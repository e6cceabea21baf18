// SPDX-License-Identifier: Apache-2.0
// The lines of a question as definitions of Coq.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/formal/coq_expression.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// An item of a list, and the comment before it.
struct CoqItem {
  std::string comment, text;
};

/// Returns the list in the notation of Coq. `margin` begins each line but the first.
[[nodiscard]] std::string coq_list(const std::vector<CoqItem>& items, const std::string& margin);

/// Takes the part of `text` before `mark`, and `mark`; all of it if there is none.
std::string_view take_until(std::string_view& text, std::string_view mark);

/// Returns the lines of a text, without their ends.
[[nodiscard]] std::vector<std::string> lines_of(const std::string& text);

/// Returns the names that the entries of a question use, and the scales, if `with_scales`, also by what
/// its lines `let` say.
[[nodiscard]] std::set<std::string, std::less<>> names_used(const std::vector<std::string>& lines,
                                                            bool with_scales);

struct CoqQuestion {
  std::string text;  ///< the definitions
  /// The number of variables that are kept to the second order. Each uncertain quantity is small
  /// and there are many.
  std::size_t second_order = 0;
  /// The identifiers of the actual quantities; `square N` is a squared length that varies, from 0.
  CoqNames names;
};

/// Returns the definitions of a question that has been read without a fault. Lines `load EXPRESSION`
/// are not part of a certificate, and may follow: the load on the robot, by column; then lines
/// `limits E : E`, by row. Or lines `factor E`, by column.
///
/// `piece_names`: the constants that each piece of a trajectory gives a value; or names that stand for
/// whole numbers of the lines `constant`, `uncertain`, `pose` and `unknown`.
[[nodiscard]] CoqQuestion coq_question(std::vector<std::string> lines, const Question& question,
                                       const std::vector<std::string>& piece_names = {});

}  // namespace regulus::verifier
