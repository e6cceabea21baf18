// SPDX-License-Identifier: GPL-3.0-or-later
// A process that decides boxes for another one prepares its questions here.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "codegen/answer/asked.hpp"
#include "codegen/answer/services.hpp"
#include "runtime/cluster/search_description.hpp"

namespace regulus::detail {

/// This process forms what the next searches of another one are about.
class RankQuestion {
 public:
  RankQuestion() = default;
  RankQuestion(const RankQuestion&) = delete;
  RankQuestion& operator=(const RankQuestion&) = delete;
  virtual ~RankQuestion() = default;

  /// Decides units of a search; what it is given lives until it returns. `make`: as for
  /// cluster::Workers::begin().
  using Decide =
      std::function<void(const Problem&, const Settings&, const cluster::MakeDecider& make)>;
  /// Calls `decide` for a search of the other process, with the kernel of this one.
  ///
  /// Throws    InternalError if the other process has another kernel; the exceptions of `decide`.
  virtual void decide_for_another(const cluster::SearchDescription& search,
                                  const Decide& decide) = 0;
};

/// Forms the matrix of the next searches of ask(), for the same question and services. `topic`: as
/// that process has told it (SearchTopic); nullopt: it has told none. Returns null if no search of the
/// question comes before its first topic.
///
/// Throws    cluster::MalformedMessage for a topic that the question does not have; InternalError if
///           the time limit ends the forming; the exceptions of ask().
[[nodiscard]] std::unique_ptr<RankQuestion> prepare_for_rank(const Asked& asked,
                                                             const Services& services,
                                                             std::optional<std::string_view> topic);

}  // namespace regulus::detail
