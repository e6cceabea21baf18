// SPDX-License-Identifier: GPL-3.0-or-later
// Tests --filter: a user's own regularity test takes part, and the report names it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "runtime/files/sha256.hpp"
#include "tests/support/command.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string filter(const std::string& name) {
  return REGULUS_BINARY_DIR "/filters/" + name + ".so";
}

/// Method `reg` alone decides few boxes, so that most remain for a filter.
CommandResult check(const std::string& model, const std::string& motion,
                    const std::vector<std::string>& filters, std::vector<std::string> more = {}) {
  std::vector<std::string> words{kCommand, "check", model, motion, "--engine", "interpreted"};
  for (const std::string& name : filters) words.insert(words.end(), {"--filter", filter(name)});
  words.insert(words.end(), more.begin(), more.end());
  return run_command(words);
}

json report(const std::string& motion, const std::vector<std::string>& filters,
            const std::string& method, const std::string& without = "") {
  std::vector<std::string> options = {"--json", "--quiet", "--method", method};
  if (!without.empty()) options.insert(options.end(), {"--without", without});
  return json::parse(check(kRobot1, motion, filters, options).output);
}

TEST(Filter, DecidesWhatTheMethodLeavesUndecided) {
  const json alone = report("T1", {}, "reg"), helped = report("T1", {"gershgorin"}, "reg");
  EXPECT_EQ(helped["verdict"], "no-singularity");
  EXPECT_GT(alone["boxes"], helped["boxes"]);
  EXPECT_GT(helped["leaves"]["filter"], 0);
  EXPECT_EQ(helped["filters"][0]["boxes"], helped["leaves"]["filter"]);
}

TEST(Filter, IsNamedInTheClaimThatRestsOnIt) {
  const CommandResult result = check(kRobot1, "T1", {"gershgorin"}, {"--method", "reg"});
  EXPECT_EQ(result.output, "NO SINGULARITY\n");
  EXPECT_THAT(
      result.errors,
      AllOf(HasSubstr("filter     gershgorin (" + filter("gershgorin") + "): "),
            HasSubstr("boxes rest on the filter gershgorin, which Regulus has not checked")));
}

TEST(Filter, LeavesTheClaimAloneWhenNothingRestsOnIt) {
  const CommandResult result = check(kRobot1, "T1", {"gershgorin"});
  EXPECT_THAT(result.errors,
              AllOf(HasSubstr("): 0 boxes rest on it"), HasSubstr("for every pose of the motion\n"),
                    Not(HasSubstr("which Regulus has not checked"))));
}

TEST(Filter, IsDescribedInJson) {
  const json filters = report("T1", {"timid", "gershgorin"}, "reg")["filters"];
  ASSERT_EQ(filters.size(), 2u);
  EXPECT_EQ(filters[0]["name"], "timid");
  EXPECT_EQ(filters[0]["boxes"], 0);
  EXPECT_EQ(filters[1]["path"], filter("gershgorin"));
  EXPECT_EQ(filters[1]["sha256"], sha256(file_contents(filter("gershgorin"))));
  EXPECT_GT(filters[1]["boxes"], 0);
  EXPECT_EQ(report("T1", {}, "auto")["filters"], json::array());
}

/// The filter certifies what is false; the only protection is that the report names it.
TEST(Filter, ThatLiesIsNamedByTheReport) {
  const CommandResult result = check(kRobot1, "wide_40", {"lying"}, {"--method", "reg"});
  EXPECT_EQ(result.output, "NO SINGULARITY\n");
  EXPECT_THAT(result.errors,
              HasSubstr("1 of 1 boxes rest on the filter lying, which Regulus has not checked"));
}

TEST(Filter, CannotVouchForWhatIsUndefined) {
  const TemporaryDirectory folder;
  const std::string path = (folder.path() / "pole.toml").string();
  std::ofstream(path) << "regulus = 1\nname = \"pole\"\nsource = \"a test\"\n[pose]\nx = \"m\"\n"
                         "[matrix]\nrows = [[\"1/x\"]]\n[motion.all]\nx = [-1, 2]\n";
  const CommandResult result = check(path, "all", {"lying"});
  EXPECT_EQ(result.output, "POSSIBLE PROBLEM\n");
}

TEST(Filter, ThatChangesTheRoundingOrThrowsIsNotBelieved) {
  for (const char* name : {"upward", "throwing"}) {
    // Filters see the model's own matrix, whose columns are as they are written.
    const json with = report("wide_15", {name}, "auto");
    const json without = report("wide_15", {}, "auto", "columns");
    EXPECT_EQ(with["filters"][0]["boxes"], 0) << name;
    EXPECT_EQ(with["boxes"], without["boxes"]) << name;
    EXPECT_EQ(with["verdict"], "no-singularity") << name;
  }
}

TEST(Filter, IsNotAskedToVouchForAThresholdItCannotSee) {
  const CommandResult result =
      check(kPlanar, "regular", {"gershgorin"}, {"--alpha", "1/1000", "--method", "reg"});
  EXPECT_THAT(result.errors, HasSubstr("): 0 boxes rest on it"));
}

TEST(Filter, IsRefusedWhenItCannotBeUsed) {
  const auto refusal = [](const std::string& name) { return check(kPlanar, "regular", {name}); };
  const CommandResult missing = refusal("no_such_filter");
  EXPECT_EQ(missing.exit_code, 74);
  EXPECT_THAT(missing.errors, HasSubstr("no_such_filter.so cannot be read: there is no such file"));
  EXPECT_EQ(refusal("newer").exit_code, 65);
  EXPECT_THAT(refusal("newer").errors,
              HasSubstr("the filter has ABI 2, but this Regulus has ABI 1"));
  EXPECT_EQ(refusal("empty").exit_code, 65);
  EXPECT_THAT(refusal("empty").errors, HasSubstr("no symbol regulus_filter"));
  EXPECT_EQ(refusal("nameless").exit_code, 65);
  EXPECT_THAT(refusal("nameless").errors,
              HasSubstr("the name of the filter does not have 1 to 64"));
  const CommandResult text = regulus({"check", kPlanar, "regular", "--filter", kPlanar});
  EXPECT_EQ(text.exit_code, 65);
  EXPECT_THAT(text.errors, HasSubstr("the filter cannot be loaded: it is not a shared object"));
}

TEST(Filter, InTheManualIsTheOneTestedHere) {
  const std::string source =
      file_contents(REGULUS_SOURCE_DIR "/tests/command/filters/gershgorin.cpp");
  const std::string shown = source.substr(source.find("// Gershgorin"));
  EXPECT_THAT(file_contents(REGULUS_SOURCE_DIR "/codegen/use/command/METHODS.md"),
              HasSubstr(shown));
}

}  // namespace
}  // namespace regulus::detail::test
