// SPDX-License-Identifier: GPL-3.0-or-later
// The cells of the paper's tables with their certificates.
#pragma once

#include "paper/driver/table_rows.hpp"
#include "support/certificates.hpp"

namespace regulus::test {

inline void expect_verified(const TableCell& of) {
  const PaperCell& cell = *of.cell;
  codegen::SearchOptions search;
  search.method = cell.method;
  search.uncertainty = cell.uncertainty;
  const Certified certified = certify(robot(of.table->model, cell.motion, cell.tolerance), search);
  ASSERT_EQ(certified.result.verdict, cell.found) << describe(certified.result.reason);
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

}  // namespace regulus::test
