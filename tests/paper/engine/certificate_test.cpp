// SPDX-License-Identifier: GPL-3.0-or-later
// Every cell of the paper's tables that takes few boxes: verdict, boxes, and its certificate.
#include "tests/paper/engine/certificate_cells.hpp"
#include "tests/support/parameter_name.hpp"

namespace regulus::detail::test {
namespace {

class CertificatesOfTheTables : public testing::TestWithParam<TableCell> {};

TEST_P(CertificatesOfTheTables, AreVerifiedAndOfTheRecordedBoxes) { expect_verified(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Paper, CertificatesOfTheTables, testing::ValuesIn(cells_of(1, kFewBoxes)),
                         cell_name);

struct Motion {
  const char* model;
  const char* motion;
  const char* tolerance;
  const char* alpha;
};

std::ostream& operator<<(std::ostream& out, const Motion& m) {
  return out << m.model << ' ' << m.motion << ' ' << m.tolerance << ' ' << m.alpha;
}

class CertificatesOfMotions : public testing::TestWithParam<Motion> {};

TEST_P(CertificatesOfMotions, AreVerified) {
  const Motion& m = GetParam();
  ModelOptions model = robot(m.model, m.motion, m.tolerance);
  model.alpha = m.alpha;
  const Certified certified = certify(model);
  ASSERT_NE(certified.result.verdict, Verdict::kPossibleProblem);
  const verifier::Verification v = verify_text(certified.text);
  EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << v.reason;
}

INSTANTIATE_TEST_SUITE_P(
    Models, CertificatesOfMotions,
    testing::Values(
        Motion{"robot_1", "T1", "", ""}, Motion{"robot_1", "T2", "", ""},
        Motion{"robot_1", "T1_errors", "", ""}, Motion{"robot_1", "T2_errors", "", ""},
        Motion{"robot_1", "T1", "", "0.1"}, Motion{"robot_1", "T2_errors", "0.05", "0.01"},
        Motion{"robot_1", "wide_40", "", "0.001"},
        Motion{"robot_1", "table6_5_15", "0.05", "0.001"},
        Motion{"robot_2", "table5_20", "10", "0.001"}, Motion{"robot_1", "T1_errors", "0.05", ""},
        Motion{"robot_1", "T2_errors", "0.05", ""}, Motion{"robot_1", "wide_15", "", "0.001"},
        Motion{"robot_1", "wide_15", "", "0.2"}, Motion{"robot_1", "table4_5", "0.01", "0.5"},
        Motion{"robot_1", "table4_5", "", "2"}, Motion{"rump", "point", "", ""},
        Motion{"planar_3rpr", "regular", "0.2", ""}, Motion{"planar_3rpr", "crossing", "", ""}),
    parameter_name);

}  // namespace
}  // namespace regulus::detail::test
