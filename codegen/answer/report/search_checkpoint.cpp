// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/search_checkpoint.hpp"

#include "codegen/support/errors.hpp"

namespace regulus::detail {

SearchCheckpoint::SearchCheckpoint(const CheckpointOptions& options,
                                   const std::function<nlohmann::ordered_json()>& question,
                                   bool has_several)
    : interval_(options.interval) {
  if (options.path.empty()) return;
  file_ = std::make_unique<JsonCheckpoint>(options.path, question(), "the search");
  was_there_ = !file_->known().empty();
  if (has_several) file_->write_seldom(interval_);
}

void SearchCheckpoint::finish(bool can_continue) {
  if (!file_) return;
  is_kept_ = can_continue;
  if (!is_kept_) return file_->remove();
  file_->flush();
  if (!file_->failure().empty())
    throw FileError("the checkpoint " + file_->path() + " cannot " + file_->failure());
}

std::string SearchCheckpoint::line() const {
  if (!file_) return "";
  std::string text;
  if (is_kept_ && file_->failure().empty())
    text = "checkpoint " + file_->path() + ": repeat the command to continue from here\n";
  return was_there_ ? "           continued from " + file_->path() + '\n' + text : text;
}

}  // namespace regulus::detail
