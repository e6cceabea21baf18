// SPDX-License-Identifier: GPL-3.0-or-later
// The certificates of `regulus bound` and of margins within a limit prove their numbers, and are about
// the model file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;

/// J⁻¹ = [1 x/10; 0 1] with 0 ≤ x ≤ 2.
constexpr const char* kProvedShear = R"toml(regulus = 1
name = "shear"
characteristic_length = 2
[pose]
x = "cm"
y = "cm"
[matrix]
rows = [["x + 3", "x*(x + 3)/10"], [0, 2]]
row_scale = ["1/(x + 3)", "1/2"]
twist = ["v", "w"]
[load.any]
force = [[-1, 1]]
moment = { value = [1], radius = 0.5 }
[twist.along]
velocity = [1]
rotation = [[-1, 1]]
[actuators]
error = 0.1
stiffness = [2, 3]
[motion.m]
x = [0, 2]
y = 0
)toml";

class BoundCertificateTest : public testing::Test {
 protected:
  BoundCertificateTest() { write(kProvedShear); }

  void write(const std::string& text) const { std::ofstream(model_, std::ios::trunc) << text; }
  /// Writes the model with another text in place of `from`.
  void change(const std::string& from, const std::string& to) const {
    std::string text = kProvedShear;
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write(text.replace(at, from.size(), to));
  }
  static CommandResult run(std::vector<std::string> words) {
    words.front() = std::string(REGULUS_BINARY_DIR "/bin/") + words.front();
    return run_command(words);
  }
  /// Proves both ends, by both programs, about the model file.
  void expect_verified(const std::string& label) const {
    for (const char* end : {".safe", ".singular"})
      for (const char* program : {"regulus", "regulus-verify"}) {
        std::vector<std::string> words{program};
        if (words.front() == "regulus") words.emplace_back("verify");
        for (const std::string& word : {std::string("--model"), model_, proof_ + label + end})
          words.push_back(word);
        const CommandResult r = run(words);
        EXPECT_EQ(r.output, "VERIFIED\n") << label << end << r.errors;
        EXPECT_THAT(r.errors, HasSubstr("\nbound      about ")) << label << end;
      }
  }
  [[nodiscard]] CommandResult verify(const std::string& ending) const {
    return run({"regulus-verify", "--model", model_, proof_ + ending});
  }

  TemporaryDirectory folder_;
  std::string model_ = folder_.path() / "shear.toml", proof_ = folder_.path() / "proof";
};

TEST_F(BoundCertificateTest, ProvesTheNumberOfEachQuantity) {
  const std::vector<std::pair<std::string, std::string>> quantities{
      {"force", ".leg_2"},
      {"speed", ".leg_1"},
      {"error", ".v"},
      {"deflection", ".w"},
      {"sigma-min", ""},
      {"sigma-max", ""},
      {"condition", ".row_1_column_2"},
      {"determinant", ""},
      {"determinant-max", ""},
      {"x^2 - x", ""}};
  for (const auto& [quantity, label] : quantities) {
    const CommandResult r = run({"regulus", "bound", model_, quantity, "--gap", "0.1", "--threads",
                                 "1", "--certificate", proof_});
    ASSERT_EQ(r.exit_code, 0) << r.errors;
    expect_verified(label);
  }
}

TEST_F(BoundCertificateTest, ProvesAConditionNumberInTheTwoNorm) {
  const std::vector<std::string> words{"regulus", "bound",     model_, "condition",     "--norm",
                                       "2",       "--threads", "1",    "--certificate", proof_};
  const CommandResult r = run(words);
  ASSERT_EQ(r.exit_code, 0) << r.errors;
  EXPECT_THAT(r.errors, HasSubstr(".safe: below "));
  EXPECT_THAT(r.errors, HasSubstr(".singular: attains "));
  expect_verified("");
  EXPECT_THAT(
      verify(".safe").errors,
      HasSubstr("condition number in the 2-norm of J^-1 with the factors of its columns < "));
}

TEST_F(BoundCertificateTest, OfAConditionNumberInTheTwoNormIsOfTheLimit) {
  for (const auto& [limit, verdict, end] :
       {std::tuple{"3", "WITHIN\n", ".safe"}, std::tuple{"6/5", "EXCEEDED\n", ".singular"}}) {
    EXPECT_EQ(run({"regulus", "bound", model_, "condition", "--norm", "2", "--limit", limit,
                   "--certificate", proof_})
                  .output,
              verdict);
    const CommandResult r = verify(end);
    EXPECT_EQ(r.output, "VERIFIED\n") << r.errors;
    EXPECT_THAT(r.errors, testing::ContainsRegex(std::string("(>=|<) ") + limit + " at "));
  }
}

/// The witness of the last one is a pose where a vector is certainly lost, or two poses.
TEST_F(BoundCertificateTest, OfASingularMatrixSaysThatThereIsNoBound) {
  for (const char* entry : {"x - 1", "x^2 - 2"})
    for (const auto& [words, label] :
         {std::pair{std::vector<std::string>{"error"}, ".v"},
          std::pair{std::vector<std::string>{"force", "--leg", "1"}, ".leg_1"},
          std::pair{std::vector<std::string>{"condition", "--norm", "2"}, ""}}) {
      change("[0, 2]]", std::string("[0, \"") + entry + "\"]]");
      std::vector<std::string> all{"regulus", "bound", model_, "--certificate", proof_};
      all.insert(all.end(), words.begin(), words.end());
      const CommandResult r = run(all);
      EXPECT_THAT(r.output, testing::StartsWith("UNBOUNDED")) << r.errors;
      const CommandResult proof = verify(std::string(label) + ".singular");
      EXPECT_EQ(proof.output, "VERIFIED\n") << proof.errors << r.errors;
      EXPECT_THAT(proof.errors, HasSubstr("has no bound"));
    }
}

TEST_F(BoundCertificateTest, ProvesASignedNumberAndALeastOne) {
  for (const char* side : {"--signed", "--min"})
    for (const char* quantity : {"force", "speed", "deflection"}) {
      const CommandResult r = run({"regulus", "bound", model_, quantity, side, "--gap", "0.1",
                                   "--threads", "1", "--certificate", proof_});
      ASSERT_EQ(r.exit_code, 0) << r.errors;
      expect_verified(std::string(quantity) == "deflection" ? ".v" : ".leg_1");
    }
}

TEST_F(BoundCertificateTest, IsOfTheLimitThatWasAsked) {
  ASSERT_EQ(
      run({"regulus", "bound", model_, "force", "--limit", "sqrt(7)", "--certificate", proof_})
          .output,
      "WITHIN\n");
  const CommandResult r = verify(".leg_1.safe");
  EXPECT_EQ(r.output, "VERIFIED\n") << r.errors;
  EXPECT_THAT(r.errors, HasSubstr("|force in row 1 under the load any| < sqrt(7) at every pose"));
}

TEST_F(BoundCertificateTest, OfALeastSingularValueIsTheSameWithItsOption) {
  for (const std::vector<std::string>& side : {std::vector<std::string>{}, {"--min"}}) {
    std::vector<std::string> words{"regulus", "bound", model_,          "sigma-min",
                                   "--limit", "0.4",   "--certificate", proof_};
    words.insert(words.end(), side.begin(), side.end());
    EXPECT_EQ(run(words).output, "WITHIN\n");
    EXPECT_EQ(verify(".safe").output, "VERIFIED\n");
  }
}

TEST_F(BoundCertificateTest, OfAMarginIsOfTheLimit) {
  const CommandResult r =
      run({"regulus", "margin", model_, "--quantity", "sigma-max", "--limit", "1.02", "--scale",
           "0.5:3.5", "--gap", "0.01", "--certificate", proof_});
  ASSERT_EQ(r.exit_code, 0) << r.errors;
  for (const char* end : {".safe", ".singular"}) {
    const CommandResult verified = run({"regulus-verify", proof_ + end});
    EXPECT_EQ(verified.output, "VERIFIED\n") << verified.errors;
    EXPECT_THAT(verified.errors, HasSubstr(" 51/50 at "));
  }
}

struct Change {
  std::string quantity, ending, from, to, message;
};

TEST_F(BoundCertificateTest, IsRefusedForAnotherModel) {
  const std::vector<Change> changes{
      {"force", ".leg_1.safe", "force = [[-1, 1]]", "force = [[-2, 2]]", "load.any.force[0][0]"},
      {"force", ".leg_1.safe", "force = [[-1, 1]]", "force = [0]", "line "},
      {"force", ".leg_1.safe", "force = [[-1, 1]]\n", "", "states 'wrench-spread' '1'"},
      {"force", ".leg_1.safe", "[load.any]", "[load.some]", "it has no load 'any'"},
      {"speed", ".leg_1.singular", "velocity = [1]", "velocity = [2]", "twist.along.velocity[0]"},
      {"speed", ".leg_1.safe", "rotation = [[-1, 1]]", "rotation = [[-1, 2]]",
       "twist.along.rotation[0][1]"},
      {"error", ".v.safe", "error = 0.1", "error = 0.2", "actuators.error"},
      {"error", ".v.safe", "error = 0.1", "error = [0.1, 0.3]", "actuators.error[1]"},
      {"deflection", ".w.safe", "stiffness = [2, 3]", "stiffness = [2, 1]", "actuators.stiffness"},
      {"sigma-max", ".safe", "characteristic_length = 2", "characteristic_length = 1",
       "characteristic_length is '1'"},
      {"sigma-max", ".safe", "row_scale = [\"1/(x + 3)\", \"1/2\"]",
       "row_scale = [\"1/(x + 3)\", 1]", "matrix.row_scale[1]"},
      {"condition", ".row_1_column_2.safe", "x*(x + 3)/10", "x*(x + 3)/9", "matrix.rows[0][1]"}};
  std::string last;
  for (const Change& c : changes) {
    if (c.quantity != last) {
      write(kProvedShear);
      ASSERT_EQ(run({"regulus", "bound", model_, c.quantity, "--gap", "0.1", "--threads", "1",
                     "--certificate", proof_})
                    .exit_code,
                0);
      last = c.quantity;
    }
    change(c.from, c.to);
    const CommandResult r = verify(c.ending);
    EXPECT_EQ(r.output, "REJECTED\n") << c.to << r.errors;
    EXPECT_THAT(r.errors, HasSubstr(c.message)) << c.to;
  }
}

}  // namespace
}  // namespace regulus::detail::test
