// SPDX-License-Identifier: GPL-3.0-or-later
// check --kernel: a person edits the text of a kernel, and the search uses it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "runtime/files/sha256.hpp"
#include "tests/support/cached_command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test::edited_kernel {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kModel =
    "regulus = 1\nname = \"small\"\n[pose]\nx = \"m\"\ny = \"m\"\n"
    "[matrix]\nrows = [[\"2 + sin(x)*y\", \"y\"], [\"-y\", \"1 + x^2\"]]\n"
    "[motion.m]\nx = [0, 1]\ny = [0, 1]\n[motion.wide]\nx = [-2, 2]\ny = [0, 1]\n";

class EditedKernel : public testing::Test {
 protected:
  EditedKernel() { write_file(model_, kModel); }

  [[nodiscard]] std::string emitted(std::vector<std::string> more = {}) const {
    std::vector<std::string> words = {kCommand, "explain", model_, "m", "--stage", "text"};
    words.insert(words.end(), more.begin(), more.end());
    return run_command(words).output;
  }
  [[nodiscard]] CommandResult check(const std::string& text,
                                    std::vector<std::string> more = {}) const {
    write_file(kernel_, text);
    std::vector<std::string> words = {kCommand, "check", model_, "m", "--kernel", kernel_};
    words.insert(words.end(), more.begin(), more.end());
    return run_command(words);
  }
  /// Replaces the first occurrence; there must be one.
  static std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
  }

  TemporaryDirectory directory_;
  std::string model_ = directory_.path() / "model.toml";
  std::string kernel_ = directory_.path() / "kernel.cpp";
};

TEST_F(EditedKernel, AnswersAsTheModelIfNothingWasEdited) {
  const json own = json::parse(
      run_command({kCommand, "check", model_, "m", "--engine", "clang", "--json", "--quiet"})
          .output);
  const std::string text = emitted();
  const json edited = json::parse(check(text, {"--json", "--quiet"}).output);
  for (const char* key : {"verdict", "boxes", "leaves", "max_frontier"})
    EXPECT_EQ(edited[key], own[key]) << key;
  EXPECT_EQ(own["kernel"], nullptr);
  EXPECT_EQ(edited["kernel"]["path"], kernel_);
  EXPECT_EQ(edited["kernel"]["sha256"], sha256(text));
}

TEST_F(EditedKernel, UsesWhatThePersonWrote) {
  // Entry A[0][0] as a constant of the width of its range: true, and so wide that nothing is shown.
  const std::vector<std::string> reg = {"--method", "reg"};
  const std::string text = emitted(reg);
  const std::size_t at = text.find("store(out, 0, ");
  ASSERT_NE(at, std::string::npos);
  const std::string wide = std::string(text).replace(at, text.find('\n', at) - at,
                                                     "store(out, 0, constant(-100.0, 100.0));");
  const CommandResult own = check(text, reg);
  EXPECT_EQ(own.output, "NO SINGULARITY\n") << own.errors;
  const CommandResult edited = check(wide, {"--method", "reg", "--max-boxes", "1000"});
  EXPECT_EQ(edited.output, "POSSIBLE PROBLEM\n") << edited.errors;
}

TEST_F(EditedKernel, IsNamedInTheClaim) {
  const CommandResult result = check(emitted());
  EXPECT_EQ(result.output, "NO SINGULARITY\n");
  EXPECT_THAT(result.errors,
              AllOf(HasSubstr("the claim is about the functions of this text"),
                    HasSubstr("of which Regulus has not proved that they are the model's")));
}

struct Mistake {
  const char* name;
  const char* from;
  const char* to;
  const char* message;
};

class Mistakes : public EditedKernel, public testing::WithParamInterface<Mistake> {};

TEST_P(Mistakes, AreNamed) {
  const CommandResult result = check(with(emitted(), GetParam().from, GetParam().to));
  EXPECT_EQ(result.exit_code, 65) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Texts, Mistakes,
    testing::Values(
        Mistake{"Syntax", "store(out, 0, ", "store(out 0, ", "the text does not compile: expected"},
        Mistake{"AnotherFunction", "store(out, 0, ", "store(out, 0, P(1.0) + ",
                "does not compute the model's functions: output 0 of matrix is in ["},
        Mistake{"AnotherSize", "    2,  // rows", "    3,  // rows",
                "the text has 3 rows, the question has 2"},
        Mistake{"NoFunction", "    left_product,  // left_product", "    nullptr,  // left_product",
                "the text has no function left_product, the search needs one"},
        Mistake{"NoIdentity", "\",  // identity", "0\",  // identity",
                "the text was written for another question"},
        Mistake{"NoSymbol", "const regulus_kernel generated_kernel = {",
                "extern const regulus_kernel other; const regulus_kernel other = {", "kernel"},
        Mistake{"Hook", "namespace {\n",
                "extern \"C\" int system(const char*);\nint run = "
                "system(\"true\");\nnamespace {\n",
                "cannot be loaded"}),
    [](const auto& of) { return std::string(of.param.name); });

TEST_F(EditedKernel, OfAnotherMotionOrMethodIsRefused) {
  const std::string text = emitted();
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--method", "kj"}, {"--range", "x=0:2", "--method", "reg"}}) {
    const CommandResult result = check(text, more);
    EXPECT_EQ(result.exit_code, 65) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("another question"));
  }
}

TEST_F(EditedKernel, HasNoProofFileAndIsForCheckAlone) {
  const std::string text = emitted();
  const CommandResult proof = check(text, {"--certificate", directory_.path() / "proof.txt"});
  EXPECT_EQ(proof.exit_code, 64);
  EXPECT_THAT(proof.errors, HasSubstr("a proof file is about the model"));
  EXPECT_EQ(check(text, {"--engine", "jit"}).exit_code, 64);
  EXPECT_EQ(check(text, {"--load", "unit"}).exit_code, 64);
}

TEST_F(EditedKernel, ThatCannotBeReadIsAFileError) {
  EXPECT_EQ(run_command({kCommand, "check", model_, "m", "--kernel", "/nowhere.cpp"}).exit_code,
            74);
  EXPECT_EQ(run_command({kCommand, "check", model_, "m", "--kernel", directory_.path()}).exit_code,
            74);
}

}  // namespace
}  // namespace regulus::detail::test::edited_kernel
