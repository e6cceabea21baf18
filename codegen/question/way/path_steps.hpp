// SPDX-License-Identifier: GPL-3.0-or-later
// What became of each part in a search of all pieces of a trajectory, in the file of --checkpoint.
//
// Which parts a search takes follows from these steps, so a run that continues takes the same. It
// judges again each part that a step says to be certified; the other steps claim nothing.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "codegen/answer/report/search_checkpoint.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::detail {

struct PathStep {
  enum class Kind : std::uint8_t {
    kCertified,  ///< by a rule
    kSplit,      ///< in a variable, if it is a part of one piece
    kLost,       ///< the piece needs a search of its own
  };
  Kind kind = Kind::kLost;
  Rule rule = Rule::kBlocked;
  std::size_t variable = 0;
};

class PathSteps {
 public:
  /// `checkpoint`: null or without a file: nothing is kept. It must outlive this object. `splittable`: the
  /// number of variables, from the first. Throws InputError for steps that no search has.
  PathSteps(const SearchCheckpoint* checkpoint, std::size_t splittable);

  /// True while steps of an earlier run are left.
  [[nodiscard]] bool is_repeating() const noexcept { return next_ < earlier_.size(); }
  /// Takes the steps of the next round, of at least one part. Returns false if there are fewer: the
  /// search finds them out.
  [[nodiscard]] bool take(std::vector<PathStep>& steps);
  /// The search was another one: the rest of the earlier steps is forgotten.
  void stop_repeating() noexcept { next_ = earlier_.size(); }

  /// Keeps the steps of a round; saves now and then. `limit`: of costly tests, to continue with.
  void add(const std::vector<PathStep>& steps, double limit = 0);
  /// Not all parts of a round were judged: from now on no steps are added. If they were steps of an
  /// earlier run, the file keeps these.
  void end(bool is_told) noexcept;
  /// Call it when the search stops.
  void save();

  /// Returns the limit of the earlier run.
  [[nodiscard]] double earlier_limit() const noexcept { return earlier_limit_; }

 private:
  void read(const nlohmann::ordered_json& saved, std::size_t splittable);

  JsonCheckpoint* const file_;
  SavePace pace_;
  std::vector<PathStep> earlier_;
  std::size_t next_ = 0;
  double earlier_limit_ = 0, limit_ = 0;
  std::string text_;
  bool has_ended_ = false, keeps_earlier_ = false;
};

}  // namespace regulus::detail
