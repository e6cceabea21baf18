// SPDX-License-Identifier: GPL-3.0-or-later
// The page of an answer, as --page of the command makes it.
#pragma once

#include <string>

#include "codegen/use/api/question.hpp"

namespace regulus {

/// What a page shows: fields of the finding of check(), margin(), bound() or check_load().
struct PageContents {
  std::string kind = "check";    ///< "check", "margin", "bound", "load" or "solutions"
  std::string headline;          ///< "NO SINGULARITY"; the `bracket` or the `result` of others
  std::string report;            ///< the lines for people
  std::string json;              ///< the report for programs
  std::string certificate{};     ///< of a check or of solutions: the file of the proof; empty: none
  std::string no_certificate{};  ///< why there is none
  /// The page without data, share/regulus/page.html of an installation; empty: that beside the
  /// folder of the program.
  std::string page_template{};
};

/// Writes one HTML file, for any browser, that shows the answer to the question: the robot, the
/// claim, and a proof that the browser does again. An earlier FILE is renamed to FILE.old.
///
/// Requires  the contents are those of an answer to this question.
/// Threads   as check(). Throws InputError for the model, UsageError if `file` is one that
///           is read, FileError if the program has no page
///           (regulus was built without npm), or a file cannot be read or written.
void write_page(const Question& question, const PageContents& contents, const std::string& file);

/// Returns the robot at the middle of the question's motion as a small picture in SVG; empty if the
/// model gives no points, or the motion is along way-points.
///
/// Threads   as check(). Throws InputError for the model.
[[nodiscard]] std::string robot_picture(const Question& question);

}  // namespace regulus
