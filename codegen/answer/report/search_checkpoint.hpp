// SPDX-License-Identifier: GPL-3.0-or-later
// The option --checkpoint of one search, or of several one after the other, whose boxes are judged
// again when it continues.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "codegen/answer/report/json_checkpoint.hpp"
#include "codegen/question/engine/options.hpp"

namespace regulus::detail {

class SearchCheckpoint {
 public:
  /// An empty path means no file. `question()`: everything that the boxes depend on.
  /// `has_several`: searches, which may be short. Throws as JsonCheckpoint.
  SearchCheckpoint(const CheckpointOptions& options,
                   const std::function<nlohmann::ordered_json()>& question,
                   bool has_several = false);

  /// Returns nullptr if there is none.
  [[nodiscard]] JsonCheckpoint* file() const noexcept { return file_.get(); }
  /// Returns the seconds between two saves, at most.
  [[nodiscard]] double interval() const noexcept { return interval_; }

  /// Call it after the search: the file stays if that can continue. Throws FileError if it could
  /// not be written then.
  void finish(bool can_continue);
  /// Returns the lines of the report.
  [[nodiscard]] std::string line() const;

 private:
  double interval_;
  std::unique_ptr<JsonCheckpoint> file_;
  bool was_there_ = false, is_kept_ = false;
};

}  // namespace regulus::detail
