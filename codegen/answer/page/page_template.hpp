// SPDX-License-Identifier: GPL-3.0-or-later
// The installed page without data: HTML with its style and its program.
#pragma once

#include <string>
#include <string_view>

namespace regulus::detail {

/// The texts of a page. They may be any UTF-8: fill() makes them safe in HTML.
struct PageTexts {
  std::string title;
  std::string verdict;  ///< "NO SINGULARITY"
  std::string claim;
  std::string report;  ///< the lines of the report, for readers without scripts
  std::string data;    ///< JSON in ASCII
};

class PageTemplate {
 public:
  /// Reads share/regulus/page.html beside the folder of the program; a build folder has the same.
  ///
  /// Throws    FileError that says how to get it, if the program was built without it.
  [[nodiscard]] static PageTemplate installed();
  /// Reads another file. Throws as installed().
  [[nodiscard]] static PageTemplate of_file(const std::string& file);

  /// Throws    FileError unless the text has each place for data once.
  explicit PageTemplate(std::string text);

  /// Returns the page.
  ///
  /// Ensures   no text can end its element, and no text runs as a script.
  [[nodiscard]] std::string fill(const PageTexts& texts) const;

 private:
  std::string text_;
};

/// Returns the text with & < > " ' as character references.
[[nodiscard]] std::string html_text(std::string_view text);

/// Returns JSON of the same value in which < > & are escaped, so that it cannot end a script element.
///
/// Requires  JSON in ASCII.
[[nodiscard]] std::string json_for_html(std::string_view json);

}  // namespace regulus::detail
