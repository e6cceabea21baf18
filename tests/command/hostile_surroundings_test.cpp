// SPDX-License-Identifier: GPL-3.0-or-later
// Callers, libraries, other processes and signals may disturb the command or the library: this
// makes no difference, or it is refused with a message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <thread>

#include "codegen/kernel/jit/cache/cache_entry.hpp"
#include "runtime/interval/floating_point_scope.hpp"
#include "tests/support/cached_command.hpp"
#include "tests/support/certificates.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// ---- The caller of the library has set another arithmetic.

#if defined(__x86_64__)

constexpr unsigned kUsual = 0x1f80;

/// Returns four roundings, with and without flush-to-zero and denormals-are-zero.
std::vector<unsigned> every_arithmetic() {
  std::vector<unsigned> all;
  for (const unsigned rounding : {0x0000U, 0x2000U, 0x4000U, 0x6000U})
    for (const unsigned flushing : {0U, 0x8000U, 0x40U, 0x8040U})
      all.push_back(kUsual | rounding | flushing);
  return all;
}

/// Not inlined: the call must not be moved out of the arithmetic that is set around it.
template <class Function>
[[gnu::noinline]] auto with_arithmetic(unsigned mxcsr, const Function& function) {
  const unsigned before = read_mxcsr();
  write_mxcsr(mxcsr);
  auto result = function();
  const unsigned after = read_mxcsr();
  write_mxcsr(before);
  EXPECT_EQ(after & ~0x3fU, mxcsr) << "the caller's arithmetic is kept";
  return result;
}

struct Asked {
  std::string name;
  ModelOptions model;
  SearchOptions search;
};

SearchOptions engine(Engine engine) {
  SearchOptions search;
  search.engine = engine;
  search.threads = 2;
  return search;
}

class AnArithmeticOfTheCaller : public testing::TestWithParam<Asked> {};

/// The certificate holds the model's numbers, the tree with its cuts, and the witness.
TEST_P(AnArithmeticOfTheCaller, ChangesNoByteOfAModelsProof) {
  const Asked& asked = GetParam();
  const std::string usual = certify(asked.model, asked.search).text;
  ASSERT_NE(usual, "");
  for (const unsigned mxcsr : every_arithmetic()) {
    SCOPED_TRACE(testing::Message() << std::hex << mxcsr);
    EXPECT_TRUE(with_arithmetic(mxcsr, [&] { return certify(asked.model, asked.search).text; }) ==
                usual);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Models, AnArithmeticOfTheCaller,
    testing::Values(Asked{"Proof", robot("robot_2", "table5_20", "20"), engine(Engine::kJit)},
                    Asked{"Witness", robot("planar_3rpr", "crossing"),
                          engine(Engine::kInterpreted)},
                    Asked{"MoreDigits", robot("rump", "point"), engine(Engine::kJit)}),
    [](const auto& asked) { return asked.param.name; });

/// The verifier may refuse an arithmetic that it cannot trust; it never gives another answer.
TEST(TheVerifier, RefusesAnArithmeticOfTheCallerOrIsNotMovedByIt) {
  const std::string proof = certify(robot("robot_2", "table5_20", "20")).text;
  const std::string witness = certify(robot("planar_3rpr", "crossing")).text;
  std::string wrong = proof;
  wrong.replace(wrong.find("in 2800 : 3200"), 14, "in 0000 : 3200");
  for (const unsigned mxcsr : every_arithmetic())
    for (const auto* text : std::initializer_list<const std::string*>{&proof, &witness, &wrong}) {
      const auto usual = verify_text(*text).outcome;
      const auto found = with_arithmetic(mxcsr, [&]() -> std::optional<verifier::Outcome> {
        try {
          return verify_text(*text).outcome;
        } catch (const std::runtime_error&) {
          return std::nullopt;
        }
      });
      EXPECT_TRUE(!found || *found == usual) << std::hex << mxcsr;
      if (mxcsr == kUsual) {
        EXPECT_TRUE(found.has_value());
      }
    }
}

// ---- A library changes the arithmetic, before the command starts or while it runs.

CommandResult run_after(const std::string& library, std::vector<std::string> words) {
  words.insert(words.begin(),
               {"/usr/bin/env", "LD_PRELOAD=" REGULUS_BINARY_DIR "/hostile/" + library + ".so"});
  return run_command(words);
}

class ALibraryThatWasLoadedBefore : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "the sanitizer demands to be the first library";
#endif
  }
  [[nodiscard]] std::string file(const char* name) const { return directory_.path() / name; }
  const TemporaryDirectory directory_;
};

TEST_P(ALibraryThatWasLoadedBefore, ChangesNoByteOfAVerdict) {
  const std::string certificate = file("certificate");
  for (const std::vector<std::string>& question :
       {std::vector<std::string>{kRobot1, "T2_errors", "--tolerance", "base,platform=0.05"},
        std::vector<std::string>{kRobot1, "wide_40"},
        std::vector<std::string>{kPlanar, "reach", "--alpha", "0.001"}}) {
    std::vector<std::string> words = {kCommand, "check"};
    words.insert(words.end(), question.begin(), question.end());
    words.insert(words.end(),
                 {"--json", "--quiet", "--threads", "2", "--certificate", certificate});
    const CommandResult usual = run_command(words);
    const std::string proof = file_contents(certificate);
    std::filesystem::remove(certificate);
    const CommandResult found = run_after(GetParam(), words);
    ASSERT_EQ(found.exit_code, usual.exit_code) << found.errors;
    EXPECT_EQ(file_contents(certificate), proof);
    EXPECT_EQ(timeless(json::parse(found.output)), timeless(json::parse(usual.output)));
  }
}

TEST_P(ALibraryThatWasLoadedBefore, DoesNotChangeWhatIsVerified) {
  const std::string certificate = file("certificate");
  (void)regulus({"check", kPlanar, "regular", "--certificate", certificate});
  EXPECT_EQ(run_after(GetParam(), {kCommand, "verify", certificate, "--model", kPlanar}).output,
            "VERIFIED\n");
  const CommandResult alone = run_after(GetParam(), {kVerify, certificate});
  EXPECT_TRUE(alone.output == "VERIFIED\n" || alone.exit_code == 74) << alone.errors;

  std::string text = file_contents(certificate);
  const std::string end = ": 1/36*pi";
  text.replace(text.find(end), end.size(), ": 1/3*pi");
  write_file(certificate, text);
  EXPECT_NE(run_after(GetParam(), {kCommand, "verify", certificate}).output, "VERIFIED\n");
  EXPECT_NE(run_after(GetParam(), {kVerify, certificate}).output, "VERIFIED\n");
}

INSTANTIATE_TEST_SUITE_P(Preloaded, ALibraryThatWasLoadedBefore,
                         testing::Values("downward", "upward", "truncating", "flushing",
                                         "alarming"),
                         [](const auto& library) { return std::string(library.param); });

#endif

// ---- Signals.

TEST(ASearch, ThatIsStoppedAndContinuedComesToTheSameEnd) {
  const TemporaryDirectory directory;
  const auto words = [&](const char* name) {
    return std::vector<std::string>{kCommand,
                                    "check",
                                    kRobot1,
                                    "table6_15_15",
                                    "--tolerance",
                                    "base,platform=0.1",
                                    "--engine",
                                    "interpreted",
                                    "--quiet",
                                    "--certificate",
                                    directory.path() / name};
  };
  const CommandResult usual = run_command(words("usual"));
  RunningCommand run(words("stopped"));
  for (int i = 0; i < 10; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ::kill(run.pid(), i % 2 == 0 ? SIGTSTP : SIGSTOP);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ::kill(run.pid(), SIGCONT);
  }
  const CommandResult stopped = run.wait();
  EXPECT_EQ(stopped.exit_code, usual.exit_code);
  EXPECT_EQ(stopped.output, usual.output);
  EXPECT_TRUE(file_contents(directory.path() / "stopped") ==
              file_contents(directory.path() / "usual"));
}

TEST(ASearch, ThatIsInterruptedClaimsNothingAndLeavesNothingBehind) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryDirectory directory;
    RunningCommand run({kCommand, "check", kRobot1, "table6_15_15", "--tolerance",
                        "base,platform=0.13", "--certificate", directory.path() / "certificate"});
    for (int i = 0; i < 10000 && std::filesystem::is_empty(directory.path()); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ::kill(run.pid(), signal);
    const CommandResult result = run.wait();
    EXPECT_EQ(result.exit_code, 2) << result.errors;
    EXPECT_EQ(result.output, "POSSIBLE PROBLEM\n");
    EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
  }
}

// ---- Other processes use the cache, or have changed it.

TEST(ACache, ServesManyProcessesAtOnce) {
  const CachedCommand command;
  std::vector<std::unique_ptr<RunningCommand>> running;
  const auto words = [](int question) {
    std::vector<std::string> all = CachedCommand::words(
        {"check", kPlanar, question % 2 == 0 ? "regular" : "crossing", "--json", "--quiet"});
    return all;
  };
  for (int i = 0; i < 12; ++i) running.push_back(std::make_unique<RunningCommand>(words(i)));
  std::vector<json> reports;
  for (const auto& run : running) reports.push_back(timeless(json::parse(run->wait().output)));
  for (std::size_t i = 2; i < reports.size(); ++i) EXPECT_EQ(reports[i], reports[i % 2]);
  EXPECT_EQ(command.report({"check", kPlanar, "regular"})["cache"], "hit");
}

/// The foreign parts are sealed like real entries, under the keys of the entries they replace.
TEST(ACache, IsOfNoUseWithThePartsOfAnotherModelUnderTheRightKeys) {
  const TemporaryDirectory directory;
  const auto model = [&](const char* name, const char* entry) {
    const std::string path = directory.path() / name;
    write_file(path,
               std::string("regulus = 1\nname = \"m\"\n[pose]\nx = \"1\"\n[matrix]\nrows = [[\"") +
                   entry + "\"]]\n[motion.m]\nx = [-1, 1]\n");
    return path;
  };
  const std::string safe = model("safe.toml", "x + 3"), singular = model("singular.toml", "x");
  const CachedCommand command;
  const auto objects_of = [&](const std::string& path) {
    std::set<std::filesystem::path> before, after;
    for (const auto& file : command.objects()) before.insert(file);
    (void)command.run({"check", path});
    for (const auto& file : command.objects())
      if (!before.contains(file)) after.insert(file);
    return after;
  };
  (void)command.run({"check", model("first.toml", "x^3 + 7")});  // compiles the self-test, too
  const auto safe_parts = objects_of(safe), singular_parts = objects_of(singular);
  ASSERT_FALSE(safe_parts.empty());
  ASSERT_FALSE(singular_parts.empty());

  CacheEntryHeader header{};
  const std::string payload = file_contents(*safe_parts.begin()).substr(sizeof header);
  for (const auto& file : singular_parts) {
    std::memcpy(&header, file_contents(file).data(), sizeof header);
    const std::string key(header.key.data(), header.key.size());
    header = make_cache_entry_header(key, payload);
    write_file(file, std::string(reinterpret_cast<const char*>(&header), sizeof header) + payload);
    ASSERT_TRUE(open_cache_entry(key, file_contents(file)));
  }
  EXPECT_EQ(command.run({"check", singular}).output, "SINGULARITY\n");
  EXPECT_EQ(command.run({"check", singular, "--engine", "auto"}).output, "SINGULARITY\n");
}

/// Replaces all entries at once: by other bytes, by a part of the entry, by the next entry.
TEST(ACache, IsMadeAnewWhereverItIsSpoilt) {
  const CachedCommand command;
  const std::vector<std::string> check = {"check", kPlanar, "crossing"};
  const json first = timeless(command.report(check));
  (void)command.report({"check", kPlanar, "regular", "--method", "reg"});
  using Spoil = std::function<std::string(const std::string& own, const std::string& next)>;
  const Spoil spoils[] = {
      [](const std::string&, const std::string&) { return std::string(5000, 'x'); },
      [](const std::string& own, const std::string&) { return own.substr(0, own.size() / 2); },
      [](const std::string&, const std::string& next) { return next; },
      [](const std::string&, const std::string&) { return std::string(); }};
  for (const Spoil& spoil : spoils) {
    std::vector<std::filesystem::path> files = command.objects();
    for (const auto& file : command.programs()) files.push_back(file);
    for (const auto& file : command.problems()) files.push_back(file);
    ASSERT_GE(files.size(), 4U);
    std::vector<std::string> contents;
    for (const auto& file : files) contents.push_back(file_contents(file));
    for (std::size_t i = 0; i < files.size(); ++i)
      write_file(files[i], spoil(contents[i], contents[(i + 1) % files.size()]));
    EXPECT_EQ(timeless(command.report(check)), first);
  }
}

}  // namespace
}  // namespace regulus::detail::test
