// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a crash, a hang or a leak is assigned to one model, and that the summary shows it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <map>
#include <sstream>

#include "tests/attack/families/families.hpp"
#include "tests/attack/runner/progress.hpp"
#include "tests/attack/runner/summary.hpp"
#include "tests/attack/runner/workers.hpp"

namespace regulus::detail::attack {
namespace {

Attack small_model() {
  Attack attack;
  attack.family = "small";
  attack.model.pose = {{"x", "[0, 1]", ""}};
  attack.model.rows = {{{"x + 2"}}};
  attack.truth = Truth::kRegular;
  attack.decidable = true;
  return attack;
}

Job small_job(std::uint64_t count, std::map<std::uint64_t, Outcome>& outcomes) {
  Job job;
  job.count = count;
  job.make = [](std::uint64_t) { return small_model(); };
  job.done = [&outcomes](std::uint64_t i, const Outcome& o) {
    EXPECT_FALSE(outcomes.contains(i)) << i;
    outcomes[i] = o;
  };
  return job;
}

TEST(Workers, DoEachModelOnce) {
  std::map<std::uint64_t, Outcome> outcomes;
  EXPECT_TRUE(run_all(small_job(20, outcomes)));
  ASSERT_EQ(outcomes.size(), 20U);
  for (const auto& [i, outcome] : outcomes) {
    EXPECT_EQ(judge(small_model(), outcome), Judgement::kTrue) << outcome.reason;
    EXPECT_EQ(outcome.proof, Proof::kVerified) << outcome.proof_reason;
  }
}

TEST(Workers, NameTheModelThatCrashesOrHangs) {
  std::map<std::uint64_t, Outcome> outcomes;
  Job job = small_job(12, outcomes);
  job.limits.seconds = 0.5;
  job.make = [](std::uint64_t i) {
    if (i == 3) std::abort();
    if (i == 5) _exit(7);
    for (volatile bool spin = i == 7; spin;) continue;
    return small_model();
  };
  EXPECT_TRUE(run_all(job));
  ASSERT_EQ(outcomes.size(), 12U);
  EXPECT_EQ(outcomes[3].ending, Ending::kCrashed);
  EXPECT_NE(outcomes[3].reason.find("signal"), std::string::npos) << outcomes[3].reason;
  EXPECT_EQ(outcomes[5].ending, Ending::kCrashed);
  EXPECT_NE(outcomes[5].reason.find("code 7"), std::string::npos) << outcomes[5].reason;
  EXPECT_EQ(outcomes[7].ending, Ending::kSlow);
  for (const std::uint64_t i : {0, 4, 6, 8, 11}) EXPECT_EQ(outcomes[i].ending, Ending::kReturned);
}

TEST(Workers, CarryFalsifiedVerdicts) {
  std::map<std::uint64_t, Outcome> outcomes;
  Job job = small_job(2, outcomes);
  job.mutant = Mutant::kFlipped;
  EXPECT_TRUE(run_all(job));
  EXPECT_EQ(judge(small_model(), outcomes.at(0)), Judgement::kContradiction);
  EXPECT_EQ(outcomes.at(0).proof, Proof::kNone);
}

TEST(ASummary, CountsAndNamesFailures) {
  Summary summary;
  Outcome outcome;
  outcome.exit_code = 0;
  outcome.proof = Proof::kVerified;
  summary.add(small_model(), outcome);
  EXPECT_FALSE(summary.failed());
  EXPECT_EQ(summary.verified_percent(), 100);
  outcome.proof = Proof::kUnfinished;
  summary.add(small_model(), outcome);
  EXPECT_FALSE(summary.failed());
  EXPECT_EQ(summary.verified_percent(), 50);
  outcome.exit_code = 1;
  Attack wrong = small_model();
  wrong.seed = 77;
  summary.add(wrong, outcome);
  EXPECT_TRUE(summary.failed());
  EXPECT_EQ(summary.count(Judgement::kContradiction), 1U);
  EXPECT_NE(summary.failure_lines("attack", 5).find("attack --show small:77"), std::string::npos);
  EXPECT_NE(summary.table().find("small"), std::string::npos);
  EXPECT_NE(summary.json().find("\"CONTRADICTION\""), std::string::npos);
}

TEST(ASummary, CountsAProofThatIsSlowAsNotVerified) {
  Summary summary;
  Outcome outcome;
  outcome.ending = Ending::kSlow;
  outcome.stage = Stage::kVerify;
  outcome.exit_code = 0;
  outcome.proof = Proof::kBroken;
  summary.add(small_model(), outcome);
  EXPECT_FALSE(summary.failed());
  EXPECT_EQ(summary.verified_percent(), 0);
  outcome.ending = Ending::kCrashed;
  summary.add(small_model(), outcome);
  EXPECT_TRUE(summary.failed());
}

TEST(ASummary, NamesEachUnfinishedProofAndTellsWhetherTheReportWarnedOfIt) {
  Summary summary;
  Outcome outcome;
  outcome.exit_code = 0;
  outcome.proof = Proof::kUnfinished;
  outcome.proof_reason = "line 7: the matrix has too many terms";
  Attack attack = small_model();
  attack.seed = 5;
  summary.add(attack, outcome);
  outcome.is_announced = true;
  attack.seed = 6;
  summary.add(attack, outcome);
  EXPECT_FALSE(summary.failed());
  EXPECT_EQ(summary.count(Proof::kUnfinished), 2U);
  EXPECT_EQ(summary.unannounced(), 1U);
  const std::string lines = summary.failure_lines("attack", 5);
  EXPECT_NE(lines.find("UNFINISHED: attack --show small:5"), std::string::npos) << lines;
  EXPECT_NE(lines.find("UNFINISHED, announced: attack --show small:6"), std::string::npos) << lines;
}

TEST(ASummary, CountsASlowProofAsSlow) {
  Summary summary;
  Outcome outcome;
  outcome.ending = Ending::kSlow;
  summary.add(small_model(), outcome);
  outcome.stage = Stage::kVerify;
  outcome.exit_code = 0;
  summary.add(small_model(), outcome);
  EXPECT_EQ(summary.slow(), 2U);
}

TEST(AProgressLine, SaysHowFarARunIs) {
  Summary summary;
  Outcome outcome;
  outcome.exit_code = 0;
  outcome.proof = Proof::kVerified;
  summary.add(small_model(), outcome);
  EXPECT_EQ(progress_text(summary, 10, 0.5), "1 of 10 models, 2.0 a second, 0 contradictions");
  outcome.exit_code = 1;
  outcome.proof = Proof::kRejected;
  summary.add(small_model(), outcome);
  EXPECT_EQ(progress_text(summary, 10, 0.5),
            "2 of 10 models, 4.0 a second, 1 contradictions, 1 proofs rejected or broken");
}

TEST(AProgressLine, IsForTerminalsOnlyAndGoesAtTheEnd) {
  std::ostringstream pipe, terminal;
  const Summary summary;
  {
    Progress silent(pipe, false, 3), loud(terminal, true, 3);
    silent.update(summary);
    loud.update(summary);
  }
  EXPECT_EQ(pipe.str(), "");
  EXPECT_NE(terminal.str().find("0 of 3 models"), std::string::npos);
  EXPECT_TRUE(terminal.str().ends_with("\r\033[K"));
}

TEST(ASummary, CountsAFalseVerdictWhoseProofCrashesTheVerifier) {
  Summary summary;
  Outcome outcome;
  outcome.ending = Ending::kCrashed;
  outcome.stage = Stage::kVerify;
  outcome.exit_code = 1;
  outcome.proof = Proof::kBroken;
  summary.add(small_model(), outcome);
  EXPECT_EQ(summary.count(Judgement::kContradiction), 1U);
  EXPECT_EQ(summary.count(Proof::kBroken), 1U);
}

}  // namespace
}  // namespace regulus::detail::attack
