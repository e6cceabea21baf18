// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/page/page_template.hpp"

#include <array>
#include <fstream>
#include <sstream>
#include <utility>

#include "codegen/support/errors.hpp"
#include "codegen/support/executable_folder.hpp"
#include "runtime/files/sha256.hpp"

namespace regulus::detail {
namespace {

constexpr std::array<const char*, 6> kPlaces = {"@REGULUS_TITLE@",  "@REGULUS_VERDICT@",
                                                "@REGULUS_CLAIM@",  "@REGULUS_REPORT@",
                                                "@REGULUS_SHA256@", "@REGULUS_DATA@"};

std::string replaced(std::string_view text,
                     const std::array<std::pair<char, const char*>, 5>& references) {
  std::string result;
  result.reserve(text.size());
  for (const char c : text) {
    const char* reference = nullptr;
    for (const auto& [character, other] : references)
      if (c == character) reference = other;
    if (reference != nullptr)
      result += reference;
    else
      result += c;
  }
  return result;
}

}  // namespace

std::string html_text(std::string_view text) {
  return replaced(
      text, {{{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}}});
}

std::string json_for_html(std::string_view json) {
  return replaced(json, {{{'<', "\\u003c"},
                          {'>', "\\u003e"},
                          {'&', "\\u0026"},
                          {'\x7f', "\\u007f"},
                          {'\0', "\\u0000"}}});
}

PageTemplate PageTemplate::installed() {
  return of_file(folder_of_executable() / "../share/regulus/page.html");
}

PageTemplate PageTemplate::of_file(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw FileError(
        "this program was built without the page that a report fills: npm was missing, or could "
        "not "
        "get its packages. Install npm (Debian: apt-get install npm), run cmake again and build; "
        "`regulus check --json` has the same data without a page");
  std::ostringstream text;
  text << in.rdbuf();
  return PageTemplate(std::move(text).str());
}

PageTemplate::PageTemplate(std::string text) : text_(std::move(text)) {
  for (const char* place : kPlaces) {
    const std::size_t first = text_.find(place);
    if (first == std::string::npos || text_.find(place, first + 1) != std::string::npos)
      throw FileError(std::string("the installed page is damaged: it must have one ") + place +
                      "; install regulus again");
  }
}

std::string PageTemplate::fill(const PageTexts& texts) const {
  const std::string data = json_for_html(texts.data);
  const std::array<std::string, kPlaces.size()> values = {
      html_text(texts.title), html_text(texts.verdict),
      html_text(texts.claim), html_text(texts.report),
      sha256(data),           data};
  std::string page;
  // From left to right, so that a value is never taken for a place.
  for (std::size_t at = 0; at < text_.size();) {
    std::size_t next = std::string::npos, which = 0;
    for (std::size_t i = 0; i < kPlaces.size(); ++i)
      if (const std::size_t found = text_.find(kPlaces[i], at); found < next) {
        next = found;
        which = i;
      }
    page.append(text_, at, next == std::string::npos ? next : next - at);
    if (next == std::string::npos) break;
    page += values[which];
    at = next + std::string_view(kPlaces[which]).size();
  }
  return page;
}

}  // namespace regulus::detail
