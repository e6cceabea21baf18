// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/generate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "codegen/kernel/cpp/words.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing::ThrowsMessage;

/// Makes A = [x + u] over one pose parameter; the test chooses its name.
std::string slider(const std::string& parameter, const std::string& motion,
                   const std::string& name = "slider") {
  return "regulus = 1\nname = " + name + "\n[pose]\n" + parameter +
         " = \"cm\"\n[geometry]\nu = { value = 0, tolerance = 0.1 }\n[matrix]\nrows = [[\"" +
         parameter + " + u\"]]\n[motion.along]\n" + parameter + " = " + motion + "\n";
}

GenerateOptions options(std::vector<Isa> isas = {Isa::kAvx2}) {
  GenerateOptions result;
  result.name = "slider";
  result.isas = std::move(isas);
  result.command = "regulus generate slider.toml";
  return result;
}

std::vector<GeneratedFile> files_of(const std::string& model,
                                    const GenerateOptions& chosen = options()) {
  ModelOptions changes;
  changes.path = "slider.toml";
  return generate(read_request(model, changes), chosen);
}

std::string text_of(const std::vector<GeneratedFile>& files, const std::string& name) {
  for (const GeneratedFile& file : files)
    if (file.name == name) return file.text;
  ADD_FAILURE() << name << " is not generated";
  return "";
}

const std::string kModel = slider("x", "[1, 2]", "\"slider\"");

TEST(Generate, GivesTheSameBytesForTheSameRequest) {
  const auto once = files_of(kModel), again = files_of(kModel);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].text, again[i].text);
}

TEST(Generate, WritesTheCommandAndTheLicenceFirst) {
  for (const GeneratedFile& file : files_of(kModel)) {
    EXPECT_THAT(file.text, StartsWith("// SPDX-License-Identifier: Apache-2.0\n")) << file.name;
    EXPECT_THAT(file.text.substr(0, 200), HasSubstr("regulus generate slider.toml")) << file.name;
  }
}

TEST(Generate, AlwaysMakesThePortableKernel) {
  std::vector<std::string> names;
  for (const GeneratedFile& file : files_of(kModel)) names.push_back(file.name);
  EXPECT_THAT(names, ElementsAre("slider.h", "slider.hpp", "slider.cpp", "slider_kernel.inc",
                                 "slider_avx2.cpp", "slider_portable.cpp"));
}

TEST(Generate, BoundsHoldTheExactRange) {
  // 1/10 lies between the double 0.1 and the double below it; 15·π/180 is not a double either.
  const std::string text =
      text_of(files_of(slider("x", "[0.1, \"15*deg\"]", "\"s\"")), "slider.hpp");
  double lo = 0, hi = 0;
  ASSERT_EQ(std::sscanf(text.c_str() + text.find("kLower = {"), "kLower = { %la", &lo), 1);
  ASSERT_EQ(std::sscanf(text.c_str() + text.find("kUpper = {"), "kUpper = { %la", &hi), 1);
  EXPECT_EQ(lo, std::nextafter(0.1, 0.0));  // the double is above 1/10
  EXPECT_GT(static_cast<long double>(hi), 0.2617993877991494365L);
  EXPECT_LT(static_cast<long double>(hi), 0.2617993877991495L);
}

TEST(Generate, RoundsTheThresholdUp) {
  const std::string text =
      text_of(files_of(slider("x", "[1, 2]\nalpha = 0.3", "\"s\"")), "slider.hpp");
  double alpha = 0;
  ASSERT_EQ(std::sscanf(text.c_str() + text.find("kAlpha"), "kAlpha = %la", &alpha), 1);
  EXPECT_EQ(alpha, std::nextafter(0.3, 1.0));  // the double is below 3/10
}

TEST(Generate, SaysWhatIsUncertainAndWhatIsClaimed) {
  const std::string text = text_of(files_of(kModel), "slider.h");
  EXPECT_THAT(text, HasSubstr("u in [-0.1, 0.1]"));
  EXPECT_THAT(text, HasSubstr("has full rank"));
  EXPECT_THAT(text, HasSubstr("double x;  // x in [1, 2] cm"));
}

TEST(Generate, KeepsKeywordsOutOfTheHeaders) {
  for (const char* word : {"double", "register", "requires", "restrict", "linux", "I"}) {
    const std::string text = text_of(files_of(slider(word, "[1, 2]", "\"s\"")), "slider.h");
    EXPECT_THAT(text, HasSubstr("double " + std::string(word) + "_;")) << word;
  }
}

TEST(Generate, KeepsTheModelsTextInComments) {
  const std::string evil = R"('*/ int hidden; /* ??/ #include </etc/passwd>')";
  for (const GeneratedFile& file : files_of(slider("x", "[1, 2]", evil))) {
    std::istringstream lines(file.text);
    for (std::string line; std::getline(lines, line);)
      if (!line.starts_with("//")) {
        EXPECT_THAT(line, Not(HasSubstr("passwd"))) << file.name;
        EXPECT_THAT(line, Not(HasSubstr("hidden"))) << file.name;
      }
  }
}

TEST(Generate, IncludesNoArithmeticIntoItsUsers) {
  const auto files = files_of(kModel);
  for (const char* name : {"slider.h", "slider.hpp"})
    EXPECT_THAT(text_of(files, name), Not(HasSubstr("interval.hpp"))) << name;
}

TEST(GenerateRefuses, NamesThatAreNone) {
  for (const char* name : {"", "9", "a b", "a-b", "int", "_a", "a__b", "regulus_x", "a\nb"}) {
    GenerateOptions chosen = options();
    chosen.name = name;
    EXPECT_THAT([&] { (void)files_of(kModel, chosen); },
                ThrowsMessage<UsageError>(HasSubstr("--name: found")))
        << name;
  }
}

TEST(GenerateRefuses, NamespacesThatAreNone) {
  for (const char* name : {"a:b", "::a", "a::", "a::int", "a;", "regulus"}) {
    GenerateOptions chosen = options();
    chosen.name_space = name;
    EXPECT_THAT([&] { (void)files_of(kModel, chosen); },
                ThrowsMessage<UsageError>(HasSubstr("--namespace: found")))
        << name;
  }
}

TEST(GenerateRefuses, AMotionWithoutARange) {
  EXPECT_THAT([] { (void)files_of(slider("x", "1", "\"s\"")); },
              ThrowsMessage<UsageError>(HasSubstr("has no range")));
}

TEST(FreeNames, AreFreeAlways) {
  for (const char* text : {"", "9 lives", "int", "a b", "__a", "é", "I", "a__b", "_"})
    EXPECT_TRUE(is_free_name(free_name(text))) << text << ": " << free_name(text);
}

}  // namespace
}  // namespace regulus::detail
