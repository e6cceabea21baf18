// SPDX-License-Identifier: GPL-3.0-or-later
// What --isa may change, and what it may not.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "runtime/interval/isa.hpp"
#include "runtime/kernel/isa.hpp"
#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;

class InstructionSet : public testing::TestWithParam<Isa> {
 protected:
  InstructionSet() {
    std::ofstream(model_) << "regulus = 1\nname = \"cubic\"\n[pose]\nx = \"1\"\n[matrix]\n"
                             "rows = [[\"x^3/3 - 0.1\"]]\n[motion.work]\nx = [-1, 1]\n";
  }

  [[nodiscard]] json report(const std::string& engine) const {
    return json::parse(regulus({"check", model_, "--isa", std::string(name(GetParam())), "--engine",
                                engine, "--no-cache", "--json", "--quiet"})
                           .output);
  }

  const TemporaryDirectory folder_;
  const std::string model_ = folder_.path() / "cubic.toml";
};

TEST_P(InstructionSet, GivesTheSameBitsWithEachEngineAndATrueEnclosure) {
  if (!supported(GetParam())) GTEST_SKIP();
  const json found = report("interpreted");
  EXPECT_EQ(found["verdict"], "singularity");
  EXPECT_EQ(found["witness"], report("jit")["witness"]);
  for (const json& point : found["witness"]["points"]) {
    const double x = point["parameters"]["x"][0];
    const auto exact = double((static_cast<long double>(x) * x * x / 3) - 0.1L);
    const double slack = 1e-19;  // of the long double
    EXPECT_LE(double(point["determinant"][0]), exact + slack);
    EXPECT_GE(double(point["determinant"][1]), exact - slack);
  }
}

/// What is printed of a point depends on the point alone.
TEST(AWitness, IsPrintedAlikeForEveryInstructionSetAndEngine) {
  const TemporaryDirectory folder;
  const std::string model = folder.path() / "model.toml";
  std::ofstream(model) << "regulus = 1\nname = \"three\"\n[pose]\nx = \"1\"\n[matrix]\n"
                          "rows = [[\"x^3/3 - 0.1\"]]\nrow_scale = [\"1/sqrt(3 + x)\"]\n"
                          "[motion.crossing]\nx = [-1, 1]\n"
                          "[motion.small]\nx = [\"0.2\", \"0.6\"]\nalpha = \"0.05\"\n";
  const std::vector<std::vector<std::string>> questions = {
      {model, "crossing"}, {model, "small"}, {kRobot1, "wide_40"}};
  for (const auto& question : questions) {
    json first;
    for (const Isa isa : kAllIsas) {
      if (!supported(isa)) continue;
      for (const char* engine : {"interpreted", "jit"}) {
        const std::vector<std::string> words{
            "check",    question[0], question[1],  "--isa",   std::string(name(isa)),
            "--engine", engine,      "--no-cache", "--quiet", "--json"};
        const json witness = json::parse(regulus(words).output)["witness"];
        ASSERT_TRUE(witness.is_object()) << question[1];
        if (first.is_null()) first = witness;
        EXPECT_EQ(witness, first) << question[1] << ' ' << name(isa) << ' ' << engine;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Each, InstructionSet, testing::ValuesIn(kAllIsas),
                         [](const auto& isa) { return std::string(name(isa.param)); });

}  // namespace
}  // namespace regulus::detail::test
