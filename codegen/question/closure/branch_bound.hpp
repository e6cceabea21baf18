// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds of quantities over one branch of a closure, over ranges or along way-points. The branch is
// first shown to be one; its boxes are then divided where the quantity may be largest, and each part has
// a tube of its own, which holds the configuration of the box that it is a part of.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "codegen/question/bound/bound_run.hpp"
#include "codegen/question/closure/branch_pieces.hpp"
#include "codegen/question/engine/search_topic.hpp"

namespace regulus::detail {

/// The searches of one request, whose components share the branch.
class BranchBounds {
 public:
  /// `value`: what the request is asked at, of a bracket; for other processes.
  explicit BranchBounds(std::optional<double> value = {}) : value_(value) {}

  /// Brackets the component, or compares it with the limit of the settings.
  ///
  /// Requires  request.model.closure; the same request each time.
  /// Throws    as prepare_closure().
  [[nodiscard]] ComponentBound bound(const Request& request, const Component& component,
                                     const BoundSettings& settings, const TimeBudget& budget);

 private:
  [[nodiscard]] std::shared_ptr<BranchInPieces> branch(const Request& request,
                                                       const Component& component, DerivativesBy by,
                                                       const BoundSettings& settings,
                                                       const TimeBudget& budget);
  /// Returns what other processes are told of the next searches.
  [[nodiscard]] SearchTopic topic_of(const Component& component, const BoundSettings& settings,
                                     TopicKind kind) const;

  const std::optional<double> value_;
  std::map<DerivativesBy, std::shared_ptr<BranchInPieces>> branches_;
};

/// For BoundSettings::over_branch.
[[nodiscard]] BoundComponent bounds_over_branch();

}  // namespace regulus::detail
