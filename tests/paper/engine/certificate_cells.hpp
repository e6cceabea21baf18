// SPDX-License-Identifier: GPL-3.0-or-later
// The cells of the paper's tables with their certificates.
#pragma once

#include "codegen/question/engine/choices.hpp"
#include "tests/paper/engine/table_rows.hpp"
#include "tests/support/certificates.hpp"

namespace regulus::detail::test {

inline void expect_verified(const TableCell& of) {
  const PaperCell& cell = *of.cell;
  SearchOptions search;
  search.method = choice_of<Method>("--method", cell.method);
  search.uncertainty = choice_of<Uncertainty>("--uncertainty", cell.uncertainty);
  const Certified certified = certify(robot(of.table->model, cell.motion, cell.tolerance), search);
  expect_as_recorded(certified.result, cell);
  if (cell.found == Verdict::kPossibleProblem) {
    EXPECT_EQ(certified.text, "") << "nothing is claimed";
    return;
  }
  const verifier::Verification v = verify_text(certified.text);
  EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << v.reason;
  if (cell.found != Verdict::kNoSingularity) return;
  std::uint64_t leaves = 0;
  for (const std::uint64_t count : certified.result.statistics.leaves) leaves += count;
  EXPECT_EQ(v.leaves, leaves);
}

}  // namespace regulus::detail::test
