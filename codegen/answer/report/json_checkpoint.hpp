// SPDX-License-Identifier: GPL-3.0-or-later
// The option --checkpoint of searches that are not about regularity: a question, and what is known
// about it, as JSON.
#pragma once

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "runtime/files/file_lock.hpp"
#include "runtime/search/saved_tree.hpp"

namespace regulus::detail {

/// When a search is saved: so often that little is lost, so seldom that it costs little.
class SavePace {
 public:
  /// `interval`: seconds between two saves, at most, unless saving takes long.
  explicit SavePace(double interval) : interval_(interval) {}

  [[nodiscard]] bool is_due() const {
    return Seconds(Clock::now() - saved_) >= std::max(interval_, kPartForSaving * cost_);
  }
  /// Calls save(), and measures it.
  template <class Save>
  void pass(const Save& save) {
    const Clock::time_point start = Clock::now();
    save();
    saved_ = Clock::now();
    cost_ = saved_ - start;
  }

 private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;
  static constexpr double kPartForSaving = 20;

  const Seconds interval_;
  Clock::time_point saved_ = Clock::now();
  Seconds cost_{0};
};

class JsonCheckpoint {
 public:
  /// Reads the file if there is one, and otherwise makes it. `question`: everything that the answer
  /// depends on. `subject`: what continues, for messages, "the search".
  ///
  /// Throws    InputError for a file that is not a checkpoint of this question, FileError if it
  ///           cannot be read or written, or if another run uses it.
  JsonCheckpoint(std::string path, const nlohmann::ordered_json& question, std::string subject);

  /// What is known beside the question; empty at first.
  [[nodiscard]] nlohmann::ordered_json& known() { return content_["known"]; }
  [[nodiscard]] const nlohmann::ordered_json& known() const { return content_.at("known"); }
  /// A file that cannot be written is noted. The run goes on without it: a file must not cost what
  /// was proved.
  void save();
  /// From now on keep() writes the file now and then, for searches that are short. flush() writes
  /// the rest.
  void write_seldom(double interval) { pace_.emplace(interval); }
  void flush();
  /// The search is over: there is nothing to continue.
  void remove() noexcept;

  /// Runs search(settings), which continues from the tree in the file, if it had one when it was
  /// read, and saves trees there. Throws InputError if the file has something else in the place of a
  /// tree. `place`: the key of the tree among what is known.
  template <class BoxSettings, class Search>
  auto continue_search(BoxSettings settings, const Search& search,
                       const std::string& place = "tree") {
    settings.save = [this, place](const SavedTree& tree) { keep(tree, place); };
    const std::optional<SavedTree> from = place != "tree" || had_tree_ ? tree(place) : std::nullopt;
    if (from) settings.from = &*from;
    try {
      return search(settings);
    } catch (const SavedTreeError& error) {
      refuse_tree(error);
    }
  }
  /// Returns the tree at a place; nullopt if there is none. Throws as refuse().
  [[nodiscard]] std::optional<SavedTree> tree(const std::string& place) const;
  /// Puts it there, and saves the file, unless write_seldom() was called.
  void keep(const SavedTree& tree, const std::string& place);
  [[noreturn]] void refuse_tree(const SavedTreeError& error) const;

  /// Returns a line that warns of a file that could not be written; empty if it was.
  [[nodiscard]] std::string line() const;
  /// Returns why the last attempt to save failed; empty if it did not.
  [[nodiscard]] const std::string& failure() const noexcept { return failure_; }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  /// Throws InputError, with the name of the file.
  [[noreturn]] void refuse(const std::string& why) const;

 private:
  [[nodiscard]] nlohmann::ordered_json read(const std::string& text,
                                            const nlohmann::ordered_json& question) const;
  /// Throws    std::exception.
  void write() const;

  const std::string path_, subject_;
  std::optional<FileLock> lock_;
  nlohmann::ordered_json content_;
  std::optional<SavePace> pace_;
  bool had_tree_ = false, is_written_ = true;
  std::string failure_;  ///< of the last attempt to save
};

}  // namespace regulus::detail
