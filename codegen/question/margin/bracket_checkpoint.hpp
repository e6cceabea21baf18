// SPDX-License-Identifier: GPL-3.0-or-later
// The option --checkpoint of brackets: the outcomes of the searches of earlier runs, in a file.
#pragma once

#include <memory>
#include <string>

#include "codegen/answer/report/json_checkpoint.hpp"
#include "codegen/question/margin/margin_run.hpp"

namespace regulus::detail {

/// Keeps the outcomes of all searches of brackets. A later run does not repeat the searches on the
/// way to an end, but that of the end itself: nothing that it reports as proved rests on the file.
class BracketCheckpoint {
 public:
  /// Reads the file if there is one. `question`: a text with everything that the ends depend on.
  ///
  /// Throws    InputError for a file that is not a checkpoint of this question, FileError if it
  ///           cannot be read or written, or if another run uses it.
  BracketCheckpoint(std::string path, const nlohmann::ordered_json& question);

  /// Returns the searches of a bracket, which refer to this object. `label`: of what is
  /// bracketed; `reference`: y of question/quantity/bordered.hpp, or 0.
  [[nodiscard]] std::unique_ptr<EarlierSearches> searches_of(const MarginQuestion& bracket,
                                                             const std::string& label,
                                                             const std::string& reference);

  /// Returns the file, for the search of a bound that is no bracket of searches.
  [[nodiscard]] JsonCheckpoint& file() noexcept { return file_; }
  /// Returns a line that warns of a file that could not be written; empty if it was.
  [[nodiscard]] std::string line() const { return file_.line(); }

 private:
  class Searches;

  JsonCheckpoint file_;
};

}  // namespace regulus::detail
