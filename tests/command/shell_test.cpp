// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the shell: scripts through a pipe, and the completions that Tab offers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "codegen/model/request.hpp"
#include "codegen/support/exit_code.hpp"
#include "codegen/use/shell/shell_completion.hpp"
#include "codegen/use/shell/shell_words.hpp"
#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;

/// Runs `regulus shell` with the script as its standard input, after setting variables.
CommandResult shell(const std::string& script, const std::string& option = "",
                    const std::string& variables = "") {
  const TemporaryDirectory directory;
  const std::string file = (directory.path() / "script").string();
  std::ofstream(file) << script;
  return run_command(
      {"/bin/sh", "-c", variables + " " + kCommand + " shell " + option + " < " + file});
}

std::string loaded(const std::string& script) { return "load " + kPlanar + "\n" + script; }

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  return text.substr(text.rfind('\n', end) + 1, end - text.rfind('\n', end));
}

TEST(ShellScript, ChecksAMotionAndEndsWithTheCodeOfTheVerdict) {
  const CommandResult regular = shell(loaded("motion regular\ncheck\n"));
  EXPECT_EQ(regular.exit_code, kNoSingularity) << regular.errors;
  EXPECT_EQ(last_line(regular.output), "NO SINGULARITY");
  const CommandResult crossing = shell(loaded("motion crossing\ncheck\nquit\ncheck nothing\n"));
  EXPECT_EQ(crossing.exit_code, kSingularity) << crossing.errors;
  EXPECT_EQ(last_line(crossing.output), "SINGULARITY");
}

TEST(ShellScript, ReportsWhatTheCommandReports) {
  const CommandResult alone =
      regulus({"check", kPlanar, "crossing", "--engine", "interpreted", "--json", "--quiet"});
  const CommandResult script =
      shell(loaded("set engine interpreted\nmotion crossing\ncheck --json --quiet\n"));
  const auto without_time = [](nlohmann::json report) {
    report.erase("seconds");
    return report;
  };
  EXPECT_EQ(without_time(nlohmann::json::parse(script.output.substr(script.output.find('{')))),
            without_time(nlohmann::json::parse(alone.output)));
}

TEST(ShellScript, KeepsWhatIsSet) {
  const CommandResult result = shell(
      loaded("motion crossing\nset range phi=-15*deg:5*deg\nset method kj\nshow settings\ncheck\n"
             "unset range phi\ncheck\n"));
  EXPECT_EQ(result.exit_code, kSingularity) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("range phi=-15*deg:5*deg\nmethod kj\nNO SINGULARITY\n"));
}

TEST(ShellScript, StopsAtTheFirstErrorAndNamesItsLine) {
  const CommandResult result = shell(loaded("motion regular\n\n# a remark\nmotoin x\ncheck\n"));
  EXPECT_EQ(result.exit_code, kUsageError);
  EXPECT_EQ(result.errors, "regulus: line 5: unknown command 'motoin'; did you mean 'motion'?\n");
  EXPECT_THAT(result.output, testing::Not(HasSubstr("NO SINGULARITY")));
}

TEST(ShellScript, KeepsGoingWhenItIsTold) {
  const CommandResult result =
      shell(loaded("set keep-going on\nmotion nothing\nmotion regular\ncheck\n"));
  EXPECT_EQ(result.exit_code, kNoSingularity);
  EXPECT_THAT(result.errors, HasSubstr("line 3"));
}

TEST(ShellScript, EndsWithTheExitCodeOfTheError) {
  EXPECT_EQ(shell("load /nowhere.toml\n").exit_code, kFileError);
  EXPECT_EQ(shell("check\n").exit_code, kUsageError);
  EXPECT_EQ(shell(loaded("check --nonsense\n")).exit_code, kUsageError);
  EXPECT_EQ(shell("load '" REGULUS_SOURCE_DIR "/README.md'\n").exit_code, kBadInput);
}

TEST(ShellScript, RefusesASettingAndKeepsTheOldOne) {
  const std::string script =
      "set keep-going on\nmotion regular\nset range q=1\nset range x=2:1\nset method none\n"
      "set mehtod kj\nset tolerance nobody=1\nset alpha -1\nshow settings\n";
  const CommandResult result = shell(loaded(script));
  for (const char* line : {"line 4", "line 5", "line 7", "line 8", "line 9"})
    EXPECT_THAT(result.errors, HasSubstr(line));
  EXPECT_THAT(result.errors, HasSubstr("unknown option 'mehtod'; did you mean 'method'?"));
  EXPECT_THAT(result.output, EndsWith("motion regular\n"));
}

TEST(ShellScript, EditsTheMatrixAndTheSubExpressions) {
  const TemporaryDirectory directory;
  const std::string saved = (directory.path() / "saved.toml").string();
  const CommandResult result =
      shell(loaded("set let e1_y y - a1_2 + 1\nset entry 1 3 x - x + 1/7\nset entry 3 1 'e3_x'\n"
                   "motion regular\nset let s sin(phi)\nsave " +
                   saved + "\n"));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("time "));
  std::ifstream original(kPlanar), edited(saved);
  std::string before, after;
  std::vector<std::string> changed;
  while (std::getline(original, before) && std::getline(edited, after)) {
    if (after.starts_with("edited = ")) {
      changed.push_back(after);
      std::getline(edited, after);
    }
    if (before != after) changed.push_back(after);
  }
  EXPECT_THAT(changed, ElementsAre("e1_y = \"y - a1_2 + 1\"",
                                   "edited = \"let e1_y, entry (1,3), entry (3,1), let s\"",
                                   "  [\"e1_x\", \"e1_y\", \"x - x + 1/7\"],"));
}

/// The matrix of another robot, or of none, does not let a platform give way.
TEST(ShellScript, SaysNothingOfARobotWhoseMatrixItHasChanged) {
  const std::string legs = "load robot_1\nmotion wide_15\n";
  EXPECT_THAT(shell(legs + "check\n").errors, HasSubstr("the platform cannot give way"));
  const CommandResult edited = shell(legs + "set entry 1 1 x/7\nshow settings\ncheck\n");
  EXPECT_THAT(edited.errors, HasSubstr("matrix     edited: entry (1,1)\n"));
  EXPECT_THAT(edited.errors, testing::Not(HasSubstr("platform cannot")));
  EXPECT_THAT(edited.errors, testing::Not(HasSubstr("platform can ")));
  EXPECT_THAT(edited.output, HasSubstr("motion wide_15\nchanged entry (1,1)\n"));
}

TEST(ShellScript, TakesChangesBack) {
  const CommandResult result = shell(
      loaded("motion crossing\nset range phi=-15*deg:5*deg\nset let e1_y y - a1_2 + 1\nundo\nundo\n"
             "show settings\nundo\nundo\nundo\n"));
  EXPECT_THAT(result.output,
              HasSubstr("taken back: set let e1_y y - a1_2 + 1\n"
                        "taken back: set range phi=-15*deg:5*deg\n"
                        "model " +
                        kPlanar + "\nmotion crossing\ntaken back: motion crossing\n"));
  EXPECT_EQ(result.exit_code, kUsageError);
  EXPECT_THAT(result.errors, HasSubstr("line 10: nothing is left to undo"));
}

TEST(ShellScript, TellsHowToSet) {
  const CommandResult result = shell(loaded("motion regular\nset alpha 0.1\nset\n"));
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("set OPTION [VALUE] sets an option; help set lists them\n"
                                       "model " +
                                       kPlanar + "\nmotion regular\nalpha 0.1\n"));
}

TEST(ShellScript, ListsItsCommandsIn80Columns) {
  std::istringstream lines(shell("help\nhelp set\nhelp check\nhelp locate\nhelp margin\n").output);
  for (std::string line; std::getline(lines, line);) {
    const bool is_one_word = line.find("closed-form}") != std::string::npos ||
                             line.find("|closed-form") != std::string::npos;
    EXPECT_TRUE(is_one_word || line.size() <= 82) << line;  // "K·J⁻¹" has more bytes
    EXPECT_THAT(line, testing::Not(HasSubstr("]show"))) << line;
  }
}

TEST(ShellScript, SaysInHelpWhatEachCommandDoes) {
  const std::string help = shell("help\n").output;
  EXPECT_THAT(help, testing::Not(HasSubstr(";\n")));
  EXPECT_THAT(help,
              HasSubstr("settings]\n                              show the output of explain"));
}

TEST(ShellScript, RefusesAnEditAndKeepsTheModel) {
  const CommandResult result =
      shell(loaded("set keep-going on\nset entry 9 1 x\nset entry 1 1 x+nobody\nset let none 1\n"
                   "motion regular\ncheck\n"));
  EXPECT_EQ(result.exit_code, kNoSingularity);
  EXPECT_THAT(result.errors,
              HasSubstr("line 3: the model file has no expression for the entry 9 1"));
  EXPECT_THAT(result.errors, HasSubstr("undeclared name 'nobody'"));
  EXPECT_THAT(result.errors,
              HasSubstr("line 5: the model file has no expression for the sub-expression 'none'"));
}

TEST(ShellScript, CompilesWhatAnEditChanges) {
  const TemporaryDirectory directory;
  const std::string cache = "XDG_CACHE_HOME=" + directory.path().string();
  const CommandResult result =
      shell("set json on\n" + loaded("motion regular\nset let e1_y y - a1_2 + 1\n"
                                     "set let e1_y y - a1_2 + 2\nset let e1_y y - a1_2 + 1\n"),
            "", cache);
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  std::istringstream lines(result.output);
  std::string line;
  std::vector<nlohmann::json> edits;
  while (std::getline(lines, line))
    if (const auto object = nlohmann::json::parse(line); object.contains("compiled"))
      edits.push_back(object);
  ASSERT_EQ(edits.size(), 3U);
  EXPECT_EQ(edits[0]["compiled"], edits[0]["functions"]);
  EXPECT_LT(edits[1]["compiled"], edits[1]["functions"]);
  EXPECT_GT(edits[1]["compiled"], 0);
  EXPECT_EQ(edits[2]["cache"], "hit");
  EXPECT_GT(edits[1]["seconds"]["compile"], 0.0);
}

TEST(ShellScript, EditsTheTextInTheEditorOfItsUser) {
  const CommandResult result =
      shell(loaded("motion regular\nedit\nshow matrix\n"), "",
            R"(VISUAL= EDITOR="sed -i -e 's/e1_y = .*/e1_y = \"y + 7\"/'")");
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("kernel "));
  EXPECT_THAT(result.output, HasSubstr("A(1,2) = y + 7"));
  EXPECT_EQ(shell(loaded("edit\n"), "", "VISUAL=false").exit_code, kFileError);
}

/// The first change by the editor is a mistake, and the second one undoes it.
TEST(ShellScript, KeepsATextWithAMistakeForTheNextEdit) {
  const CommandResult result =
      shell(loaded("set keep-going on\nedit\nmotion regular\ncheck\nedit\nedit\n"), "",
            "VISUAL= EDITOR=\"sed -i -e 's/nobody . //;t' -e 's/x - a1_1/nobody + x - a1_1/'\"");
  EXPECT_THAT(result.errors, HasSubstr("line 3: " + kPlanar + ":"));
  EXPECT_THAT(result.errors, HasSubstr("line 7: " + kPlanar + ":"));
  EXPECT_THAT(result.errors, testing::Not(HasSubstr("line 6: ")));
  EXPECT_EQ(result.exit_code, kBadInput);
  EXPECT_THAT(result.output, HasSubstr("NO SINGULARITY"));
}

TEST(ShellScript, ReadsTheFileAgainAndKeepsWhatIsSet) {
  const TemporaryDirectory directory;
  const std::string model = (directory.path() / "robot.toml").string();
  std::filesystem::copy_file(kPlanar, model);
  // This editor changes the model file itself, not the text that it receives.
  const std::string meddler = (directory.path() / "meddler").string();
  std::ofstream(meddler) << "sed -i -e 's/x - a1_1/x - a1_1 + 7/' " << model << '\n';
  const CommandResult result = shell("load " + model +
                                         "\nmotion regular\nset range x=1:2\nedit\nreload\n"
                                         "show settings\nshow matrix\n",
                                     "", "VISUAL='sh " + meddler + "'");
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("motion regular\nrange x=1:2"));
  EXPECT_THAT(result.output, HasSubstr("A(1,1) = x + 7"));
}

TEST(ShellScript, PlotsAPaving) {
  const TemporaryDirectory directory;
  const std::string picture = (directory.path() / "curve.svg").string();
  const CommandResult result =
      shell(loaded("motion circle\nplot " + picture + " --resolution 1/8\n"));
  EXPECT_LE(result.exit_code, kPossibleProblem) << result.errors;
  std::ifstream file(picture);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(text, HasSubstr("<svg"));
  EXPECT_THAT(text, HasSubstr("</svg>"));
  EXPECT_EQ(shell(loaded("motion circle\nplot\n")).exit_code, kUsageError);
}

TEST(ShellScript, PrintsEachResultAsAJsonObjectOnALine) {
  const CommandResult result = shell(
      loaded("motions\nmotion regular\ncheck\nlocate --resolution 1/2\nshow matrix\nhistory\n"),
      "--json");
  ASSERT_EQ(result.exit_code, kNoSingularity) << result.errors;
  std::istringstream lines(result.output);
  std::string line;
  std::vector<nlohmann::json> objects;
  while (std::getline(lines, line)) objects.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(objects.size(), 6U);
  EXPECT_EQ(objects[0]["motions"].size(), 5U);
  EXPECT_EQ(objects[2]["verdict"], "no-singularity");
  EXPECT_THAT(objects[4]["text"].get<std::string>(), HasSubstr("A(3,3)"));
  EXPECT_EQ(objects[5]["history"].size(), 7U);
}

TEST(ShellScript, ShowsPartsOfTheForms) {
  const CommandResult result = shell(loaded("show matrix\nshow occurrences\n"));
  EXPECT_THAT(result.output, HasSubstr("A(1,1) ="));
  EXPECT_THAT(result.output, HasSubstr("Occurrences of each variable"));
  EXPECT_THAT(result.output, testing::Not(HasSubstr("Functions of the kernel")));
}

TEST(ShellScript, MarginAndVerifyAreTheCommands) {
  const TemporaryDirectory directory;
  const std::string proof = (directory.path() / "proof").string();
  const CommandResult result =
      shell(loaded("motion regular\nmargin --tolerance base=0:1 --gap 0.5\ncheck --certificate " +
                   proof + "\nverify " + proof + "\n"));
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("SAFE UP TO"));
  EXPECT_THAT(result.output, EndsWith("VERIFIED\n"));
}

TEST(ShellScript, HelpNamesEveryCommandAndSaysWhatTheExitCodeIs) {
  const std::string help = shell("help\nhelp quit\n").output;
  for (const char* command : {"load", "motions", "show", "set", "edit", "reload", "check", "locate",
                              "margin", "plot", "verify", "history", "save", "quit"})
    EXPECT_THAT("\n" + help, HasSubstr(std::string("\n") + command));
  EXPECT_THAT(help, HasSubstr("exit code"));
}

TEST(ShellWords, AreSeparatedByBlanksAndHeldTogetherByQuotes) {
  EXPECT_THAT(split_words("  set  let c 'cos(phi) + 1' # why"),
              ElementsAre("set", "let", "c", "cos(phi) + 1"));
  EXPECT_THAT(split_words("a\"b c\"d ''"), ElementsAre("ab cd", ""));
  EXPECT_THAT(split_words("# nothing"), IsEmpty());
  EXPECT_THROW(static_cast<void>(split_words("load 'model")), UsageError);
}

ShellNames some_names() {
  ShellNames names;
  names.commands = {"check", "load", "locate", "motion", "set", "show"};
  names.motions = {"circle", "crossing"};
  names.parameters = {"phi", "x"};
  names.groups = {"base", "platform"};
  names.options = {"alpha", "method", "range", "tolerance"};
  names.lets = {"c", "e1_x"};
  names.values_of = [](const std::string& option) {
    return option == "method" ? std::vector<std::string>{"kj", "reg", "reg+rohn"}
                              : std::vector<std::string>{};
  };
  names.files = [](const std::string& prefix) {
    return std::vector<std::string>{prefix + "a.svg", prefix + "a.toml", prefix + "more/"};
  };
  return names;
}

TEST(ShellCompletion, OffersCommandsMotionsOptionsAndTheirValues) {
  const ShellNames names = some_names();
  EXPECT_THAT(completions("lo", names), ElementsAre("load", "locate"));
  EXPECT_THAT(completions("motion c", names), ElementsAre("circle", "crossing"));
  EXPECT_THAT(completions("set me", names), ElementsAre("method"));
  EXPECT_THAT(completions("set method reg", names), ElementsAre("reg", "reg+rohn"));
  EXPECT_THAT(completions("set range ", names), ElementsAre("phi=", "x="));
  EXPECT_THAT(completions("set tolerance b", names), ElementsAre("base="));
  EXPECT_THAT(completions("set let e", names), ElementsAre("e1_x"));
  EXPECT_THAT(completions("load models/", names), ElementsAre("models/a.toml", "models/more/"));
  EXPECT_THAT(completions("verify models/", names),
              ElementsAre("models/a.svg", "models/a.toml", "models/more/"));
  EXPECT_THAT(completions("show m", names), ElementsAre("matrix"));
  EXPECT_THAT(completions("check x", names), IsEmpty());
}

TEST(ShellCompletion, OffersOptionsOfCommandsAndWhatTheyName) {
  ShellNames names = some_names();
  names.loads = {"payload"};
  names.quantities = {"error", "force"};
  names.options_of = [](const std::string& command) {
    return command == "margin" ? std::vector<std::string>{"--gap", "--grow"}
                               : std::vector<std::string>{};
  };
  EXPECT_THAT(completions("margin --g", names), ElementsAre("--gap", "--grow"));
  EXPECT_THAT(completions("margin --gap 0.1 --grow ", names), ElementsAre("phi=", "x="));
  EXPECT_THAT(completions("margin --tolerance p", names), ElementsAre("platform="));
  EXPECT_THAT(completions("check --method r", names), ElementsAre("reg", "reg+rohn"));
  EXPECT_THAT(completions("bound f", names), ElementsAre("force"));
  EXPECT_THAT(completions("bound force --load ", names), ElementsAre("payload"));
  EXPECT_THAT(completions("history --", names), IsEmpty());
}

TEST(ShellCompletion, TypesWhatAllHaveInCommon) {
  EXPECT_EQ(common_beginning({"load", "locate"}), "lo");
  EXPECT_EQ(common_beginning({"one"}), "one");
  EXPECT_EQ(common_beginning({}), "");
}

}  // namespace
}  // namespace regulus::detail::test
