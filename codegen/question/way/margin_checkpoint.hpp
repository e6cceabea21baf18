// SPDX-License-Identifier: GPL-3.0-or-later
// The option --checkpoint of `regulus margin`, about a set of poses or a path.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "codegen/question/margin/bracket_checkpoint.hpp"
#include "codegen/question/margin/margin_run.hpp"

namespace regulus::detail {

/// Returns everything that the ends of brackets about a motion depend on, with the way-points if it
/// has them, but not what is bracketed.
[[nodiscard]] nlohmann::ordered_json checkpointed_question(const Request& request,
                                                           const SearchOptions& search);

/// The searches of one bracket in a file.
class MarginCheckpoint {
 public:
  /// An empty `path` means no file. Throws as BracketCheckpoint.
  MarginCheckpoint(const std::string& path, const Request& request, const MarginQuestion& question,
                   const SearchOptions& search);

  /// Returns nullptr if there is no file.
  [[nodiscard]] EarlierSearches* searches() const noexcept { return searches_.get(); }
  /// Returns a line that warns of a file that could not be written; empty if it was.
  [[nodiscard]] std::string line() const { return file_ ? file_->line() : ""; }

 private:
  std::optional<BracketCheckpoint> file_;
  std::unique_ptr<EarlierSearches> searches_;
};

}  // namespace regulus::detail
