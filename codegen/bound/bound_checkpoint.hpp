// SPDX-License-Identifier: GPL-3.0-or-later
// The option --checkpoint of brackets: what earlier runs found, in a file.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "codegen/margin/margin_run.hpp"
#include "codegen/quantity/quantity.hpp"
#include "runtime/files/file_lock.hpp"

namespace regulus::inline bounding {

/// Keeps the ends of the bracket of each component. A later run begins with them: it proves both
/// again, so nothing that it reports rests on the file.
class BoundCheckpoint {
 public:
  /// Reads the file if there is one. `question`: a text with everything that the ends depend on.
  ///
  /// Throws    InputError for a file that is not a checkpoint of this question, FileError if it
  ///           cannot be read or created, or if another run uses it.
  BoundCheckpoint(std::string path, const nlohmann::ordered_json& question);

  /// Moves the ends of `bracket` to those of the file, if they lie between them. `label`: of the
  /// component; `reference`: a text, ends that were found with another one are left out.
  void narrow(MarginQuestion& bracket, const std::string& label,
              const std::string& reference) const;

  /// Saves an end. Throws FileError.
  void note(const std::string& label, const std::string& reference, const MarginStep& step);

 private:
  void save();

  std::string path_;
  std::optional<FileLock> lock_;
  nlohmann::ordered_json content_;
};

/// Returns everything that the ends of brackets depend on.
[[nodiscard]] nlohmann::ordered_json checkpointed_question(const Request& request,
                                                           const Quantity& quantity,
                                                           const SearchOptions& search);

}  // namespace regulus::bounding
