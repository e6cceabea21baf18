// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/kernel/kernel_headers.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "runtime/kernel/self_test.hpp"

namespace regulus::detail {
namespace {

std::string file_text(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Returns the path of a header in the source tree, for example of runtime/kernel/pack.hpp.
std::string source_path(std::string_view header) {
  return REGULUS_SOURCE_DIR "/runtime" + std::string(header.substr(header.find('/')));
}

std::set<std::string> included_by(std::string_view text) {
  static const std::regex kInclude("#include [\"<]([^\">]+)[\">]");
  const std::string copy(text);
  std::set<std::string> names;
  for (std::sregex_iterator i(copy.begin(), copy.end(), kInclude), end; i != end; ++i)
    names.insert((*i)[1]);
  return names;
}

TEST(KernelHeaders, AreTheFilesByteForByte) {
  ASSERT_FALSE(kernel_headers().empty());
  for (const KernelHeader& header : kernel_headers())
    EXPECT_EQ(header.text, file_text(source_path(header.path))) << header.path;
}

TEST(KernelHeaders, IncludeNothingButEachOther) {
  std::set<std::string> known;
  for (const KernelHeader& header : kernel_headers()) known.emplace(header.path);
  EXPECT_TRUE(known.contains("runtime/kernel/abi.hpp"));
  EXPECT_TRUE(known.contains("runtime/kernel/pack.hpp"));
  for (const KernelHeader& header : kernel_headers())
    for (const std::string& included : included_by(header.text))
      EXPECT_TRUE(known.contains(included)) << header.path << " includes " << included;
}

TEST(KernelHeaders, TheSelfTestIncludesOnlyThem) {
  const auto included = included_by(kSelfTestSource);
  EXPECT_EQ(included, std::set<std::string>{"runtime/kernel/pack.hpp"});
  EXPECT_NE(std::string_view(kSelfTestSource).find(kSelfTestSymbol), std::string_view::npos);
}

}  // namespace
}  // namespace regulus::detail
