// SPDX-License-Identifier: GPL-3.0-or-later
// Writes and verifies a certificate of each kind of question that a model file can ask.
#include <gtest/gtest.h>

#include "tests/support/cached_command.hpp"
#include "tests/support/certificates.hpp"

namespace regulus::detail::test {
namespace {

/// A planar robot with four legs, one more than it needs, and its motions.
const std::string kRedundant = R"toml(regulus = 1
name = "planar 4-RPR"
[pose]
x = "1"
y = "1"
phi = "rad"
[geometry]
a2 = { value = [16, 0], radius = "1/20", group = "base" }
a3 = { value = [0, 10], tolerance = 0, group = "base" }
a4 = { value = [16, 10], tolerance = 0, group = "base" }
[let]
c = "cos(phi)"
s = "sin(phi)"
[matrix]
rows = [
  ["x", "y", "0"],
  ["x + 4*c - a2_1", "y + 4*s - a2_2", "4*c*(y - a2_2) - 4*s*(x - a2_1)"],
  ["x - 4*s - a3_1", "y + 4*c - a3_2", "-4*s*(y - a3_2) - 4*c*(x - a3_1)"],
  ["x + 4*c - 4*s - a4_1", "y + 4*s + 4*c - a4_2", "(4*c - 4*s)*(y - a4_2) - (4*s + 4*c)*(x - a4_1)"],
]
[motion.box]
x = [5, 7]
y = [2, 4]
phi = ["-5*deg", "5*deg"]
[motion.disc]
x = [5, 7]
y = [2, 4]
phi = ["-5*deg", "5*deg"]
constraints = ["(x - 6)^2 + (y - 3)^2 - 1"]
[motion.arc]
parameters = { t = [0, "pi/2"] }
x = "6 + cos(t)"
y = "3 + sin(t)"
phi = "t/10"
error = { x = 0.01, y = 0.01, phi = "0.1*deg" }
)toml";

struct Kind {
  std::string name;
  std::string text;  ///< of a model file; empty: the planar robot of models/
  std::string motion;
  std::string tolerance, alpha;
  Verdict verdict = Verdict::kNoSingularity;
};

class ACertificateOfEachKind : public testing::TestWithParam<Kind> {};

TEST_P(ACertificateOfEachKind, IsVerified) {
  const Kind& kind = GetParam();
  const TemporaryDirectory directory;
  ModelOptions model = robot("planar_3rpr", kind.motion);
  if (!kind.text.empty()) {
    model.path = directory.path() / "model.toml";
    write_file(model.path, kind.text);
  }
  if (!kind.tolerance.empty()) model.tolerances = {"base=" + kind.tolerance};
  model.alpha = kind.alpha;
  const Certified certified = certify(model);
  ASSERT_EQ(certified.result.verdict, kind.verdict) << describe(certified.result.reason);
  const verifier::Verification v = verify_text(certified.text);
  EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << v.reason;
}

INSTANTIATE_TEST_SUITE_P(
    Driver, ACertificateOfEachKind,
    testing::Values(Kind{"Redundant", kRedundant, "box", "", ""},
                    Kind{"RedundantTolerance", kRedundant, "box", "1/10", ""},
                    Kind{"RedundantConstraint", kRedundant, "disc", "1/10", ""},
                    Kind{"RedundantErrors", kRedundant, "arc", "1/10", ""},
                    Kind{"Constraint", "", "reach", "", ""},
                    Kind{"ConstraintTolerance", "", "reach", "1/10", ""},
                    Kind{"ConstraintThreshold", "", "reach", "", "1/100"},
                    Kind{"ErrorsThreshold", "", "circle", "1/20", "1/100"},
                    Kind{"Threshold", "", "regular", "1/20", "1/100"},
                    Kind{"ThresholdNotExceeded", "", "regular", "", "100", Verdict::kSingularity},
                    Kind{"ConstraintNotExceeded", "", "reach", "", "100", Verdict::kSingularity}),
    [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace regulus::detail::test
