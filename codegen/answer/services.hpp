// SPDX-License-Identifier: GPL-3.0-or-later
// What is done for a question beside answering it: files, progress, boxes and steps as they come.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "codegen/answer/picture/picture_request.hpp"
#include "codegen/question/engine/options.hpp"
#include "codegen/question/load/force_claim.hpp"
#include "codegen/support/earlier_outputs.hpp"
#include "runtime/interval/interval.hpp"
#include "runtime/search/paving.hpp"

namespace regulus::detail {

/// The JSON lines of a paving.
struct LinesRequest {
  std::string file{};              ///< empty: none, unless there is a stream
  std::ostream* stream = nullptr;  ///< in the place of a file
  std::string name_of_stream{};    ///< for messages
  [[nodiscard]] bool is_wanted() const noexcept { return stream != nullptr || !file.empty(); }
};

/// Processes that have the same question share the places of a table: this one solves each whose
/// number from 0 is `part` modulo `parts`. The first one answers, and solves what the others have not.
struct SharedPlaces {
  std::size_t part = 0, parts = 1;
  /// Called once, with an item for each place, which is empty unless this process has solved it, and
  /// with whether it was interrupted. That of the first process completes the list. Returns whether
  /// the first process was not interrupted.
  std::function<bool(std::vector<std::string>& found, bool is_interrupted)> exchange{};
};

struct Services {
  std::string certificate{};     ///< file, of brackets without its endings; empty: none
  std::uint64_t shard_size = 0;  ///< of its shards, in bytes; 0: it is one file
  CheckpointOptions checkpoint{};
  LinesRequest lines{};
  SharedPlaces places{};
  PictureRequest pictures{};
  std::string* tree = nullptr;  ///< gets the tree of a paving, as PavingTree::text()
  std::string page{};           ///< file of a page of the answer; empty: none
  std::string typed{};          ///< the command line, for the page

  /// Precedes the names of files and options in messages: "--" of a command, nothing of a program.
  std::string dashes{};
  /// True if a terminal shows the progress.
  bool shows_progress = false;
  /// The search ends soon after it becomes true; null: it cannot be interrupted.
  const std::atomic<bool>* interrupt = nullptr;
  /// Called when the stages before a search have ended: from now on it reads `interrupt`.
  std::function<void()> on_search{};
  /// Called for a line of the report that is known before the answer, with its end of line.
  std::function<void(const std::string&)> on_line{};

  /// Called for each box of a paving, in an order that depends on the question alone, with a range
  /// for each variable; the span is valid during the call. An exception ends the search, and ask()
  /// throws it again.
  std::function<void(Claim, std::span<const Interval>)> on_box{};
  std::function<void(ForceClaim, std::span<const Interval>)> on_force_box{};

  void begin_search() const {
    if (on_search) on_search();
  }
  void tell(const std::string& line) const {
    if (on_line) on_line(line);
  }
};

}  // namespace regulus::detail
