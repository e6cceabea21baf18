// SPDX-License-Identifier: Apache-2.0
// The second part of a certificate: a tree of boxes, or a witness.
#pragma once

#include "runtime/verifier/leaf.hpp"

namespace regulus::verifier {

/// Reads splits and leaves up to the end of the file, and proves each leaf as it is read. Returns
/// if the claim NO SINGULARITY is proved; throws Rejection or Unfinished.
void check_tree(Lines& lines, Question& question, const Variety& variety, const Options& options,
                Verification& counts);

struct Shown;
struct BranchBoxes;
/// Does the same for one piece of a trajectory: reads up to the line that begins the next tree or
/// ends the file. The piece may have no pose. `before`: of a closure the boxes of the piece before,
/// none for the first one; it gets those of this piece.
Shown check_tree_of_piece(Lines& lines, Question& question, const Variety& variety,
                          const Options& options, std::optional<BranchBoxes>& before,
                          Verification& counts);

/// Does the same for the claim SINGULARITY and its witness.
void check_witness(Lines& lines, Question& question, const Variety& variety, const Options& options,
                   const Verification& counts);

/// Shows that the matrix of the model is regular all along the segment between two points, or at the
/// point if they are one. Throws Unfinished. `question`: after border().
void require_regular_model(const Question& question, const Variety& variety, const Box& from,
                           const Box& to, WorkClock& clock);

/// Returns the double that a C99 hexadecimal or a decimal text denotes. Throws Rejection for
/// another text, and for a number that is not finite.
[[nodiscard]] double read_double(std::string_view text);

/// Returns the words of a line.
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view line);

}  // namespace regulus::verifier
