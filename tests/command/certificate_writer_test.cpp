// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the certificate writer in cases that a search rarely meets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "runtime/proof/format.hpp"
#include "runtime/proof/writer.hpp"
#include "tests/support/cached_command.hpp"
#include "tests/support/certificates.hpp"
#include "tests/support/files.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kLeast = std::numeric_limits<double>::denorm_min();

/// Writes x − 1/2 with a witness; its determinants have these enclosures, the positive one first.
std::string witness_of(const Interval& positive, const Interval& negative) {
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "proof").string();
  Result result;
  result.verdict = Verdict::kSingularity;
  result.reason = Reason::kOppositeSigns;
  result.witness.emplace();
  result.witness->points.push_back(
      {.variables = {{1, 1}}, .determinant = positive, .pose = {{1, 1}}});
  result.witness->points.push_back(
      {.variables = {{0, 0}}, .determinant = negative, .pose = {{0, 0}}});
  CertificateWriter writer(path,
                           {"model m\nsha256 -\nmotion m\nalpha 0\nparameter x in 0 : 1\npose x = "
                            "x\nmatrix 1 1\nentry x - 1/2\n",
                            "",
                            "the full 1x1 matrix of the model is singular at some pose of the "
                            "variety"});
  EXPECT_TRUE(writer.finish(result));
  return file_contents(path);
}

TEST(ASignOfADeterminantThatUnderflows, IsThatOfTheOtherEnd) {
  for (const double zero : {0.0, -0.0}) {
    const std::string text = witness_of({zero, kLeast}, {-kLeast, zero});
    EXPECT_THAT(text, HasSubstr("point + 0x1p+0\npoint - 0x0p+0\npath segment\nend\n"));
    EXPECT_EQ(verify_text(text).outcome, verifier::Outcome::kVerified);
  }
  EXPECT_EQ(witness_of({0.5, 0.5}, {-0.5, -0.5}), witness_of({0, kLeast}, {-kLeast, 0}));
}

/// The file has a hole as long as the limit, which takes no disk space.
TEST(ACertificateBeyondTheLimitOfTheFormat, IsAnnouncedAsSuch) {
  const TemporaryDirectory directory;
  const std::string model = (directory.path() / "model.toml").string(),
                    path = (directory.path() / "proof").string();
  write_file(model,
             "regulus = 1\nname = \"x\"\n[pose]\nx = \"m\"\n[matrix]\nrows = [[\"x + "
             "2\"]]\n[motion.only]\nx = [0, 1]\n");
  ModelOptions options;
  options.path = model;
  const PreparedSearch preparation = prepare(options, {});
  Result result;
  result.verdict = Verdict::kNoSingularity;
  const auto report_of = [&](std::uint64_t length) {
    std::filesystem::remove(path);
    CertificateFile file(path, preparation);
    for (const auto& entry : std::filesystem::directory_iterator(directory.path()))
      if (entry.path() != model) std::filesystem::resize_file(entry.path(), length);
    file.finish(result);
    Facts facts(Readers::kPrograms);
    file.status().tell(facts);
    return std::pair(file.status().line(), facts.object());
  };
  const auto [line, report] = report_of(format::kMaxBytes);
  EXPECT_EQ(line, "proof      " + path + '\n');
  EXPECT_FALSE(report.contains("certificate_note"));
  const auto [longer_line, longer_report] = report_of(format::kMaxBytes + 1);
  EXPECT_THAT(longer_line, HasSubstr("it is larger than the 4294967296 bytes that the verifier"));
  EXPECT_THAT(longer_report["certificate_note"].get<std::string>(), HasSubstr("it is larger than"));
}

}  // namespace
}  // namespace regulus::detail::test
