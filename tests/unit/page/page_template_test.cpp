// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/page/page_template.hpp"

#include <gtest/gtest.h>

#include "codegen/answer/page/page_data.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/files/sha256.hpp"

namespace regulus::detail::test {
namespace {

const std::string kTemplate =
    "<title>@REGULUS_TITLE@</title><h1>@REGULUS_VERDICT@</h1>"
    "<p>@REGULUS_CLAIM@</p><pre>@REGULUS_REPORT@</pre>"
    "<script id=\"@REGULUS_SHA256@\">@REGULUS_DATA@</script>";

TEST(APageTemplate, TakesTextsThatLookLikeHtmlOrLikePlaces) {
  const std::string page = PageTemplate(kTemplate).fill({.title = "<b>@REGULUS_DATA@&\"'",
                                                         .verdict = "NO SINGULARITY",
                                                         .claim = "@REGULUS_CLAIM@",
                                                         .report = "</pre>",
                                                         .data = R"({"a":"</script>&"})"});
  const std::string data = R"({"a":"\u003c/script\u003e\u0026"})";
  EXPECT_EQ(page,
            "<title>&lt;b&gt;@REGULUS_DATA@&amp;&quot;&#39;</title><h1>"
            "NO SINGULARITY</h1><p>@REGULUS_CLAIM@</p><pre>&lt;/pre&gt;</pre><script id=\"" +
                sha256(data) + "\">" + data + "</script>");
}

TEST(APageTemplate, IsRefusedWithoutAPlaceOrWithTwo) {
  EXPECT_THROW(PageTemplate("<title>@REGULUS_TITLE@</title>"), FileError);
  EXPECT_THROW(PageTemplate(kTemplate + "@REGULUS_DATA@"), FileError);
}

TEST(CommandsToProveAgain, AreWordsOfAShell) {
  const auto commands = commands_to_prove_again({.path = "my robot's.toml",
                                                 .motion = "work",
                                                 .ranges = {"psi=-5*deg:5*deg"},
                                                 .tolerances = {"base=0.1"},
                                                 .alpha = "1e-3"});
  ASSERT_EQ(commands.size(), 2u);
  EXPECT_EQ(
      commands[0],
      "regulus check 'my robot'\\''s.toml' work --range 'psi=-5*deg:5*deg' --tolerance base=0.1 "
      "--alpha 1e-3 --certificate proof.txt");
  EXPECT_EQ(commands[1], "regulus verify proof.txt --model 'my robot'\\''s.toml' --allow-options");
}

}  // namespace
}  // namespace regulus::detail::test
