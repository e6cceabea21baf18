// SPDX-License-Identifier: GPL-3.0-or-later
// Brackets the largest or least value of a quantity over a motion, or compares it with a limit.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/answer/report/output_options.hpp"
#include "codegen/question/bound/attained_place.hpp"
#include "codegen/question/bound/bound_checkpoint.hpp"
#include "codegen/question/bound/bound_number.hpp"
#include "codegen/question/quantity/bordered.hpp"
#include "codegen/support/held_files.hpp"
#include "codegen/support/time_budget.hpp"

namespace regulus::detail {

enum class LimitVerdict { kWithin, kExceeded, kUndecided };

/// The result for one component.
struct ComponentBound {
  Component component;
  std::optional<BoundEnd> attained;  ///< q has this value, or a value beyond it, at `place`
  std::optional<BoundEnd> proved;    ///< no value is beyond it
  std::optional<AttainedPlace> place;
  bool is_unbounded = false;  ///< the matrix of the model is singular at `place`
  bool is_empty = false;      ///< the constraints leave no pose
  bool is_closed = false;     ///< the bracket is as narrow as wanted
  LimitVerdict verdict = LimitVerdict::kUndecided;  ///< of a limit
  std::string reason;  ///< why it is not closed, or not decided; otherwise empty
  std::uint64_t boxes = 0;
  StageSeconds seconds;
  EndProofs proofs;

  /// True if the least value of a magnitude is asked, and is 0 at `place`: no other end is missing.
  [[nodiscard]] bool attains_zero() const;
  /// True if the matrix of the model is singular at `place`.
  [[nodiscard]] bool is_singular() const { return is_unbounded || attains_zero(); }
};

struct BoundSettings;
/// Bounds a component; as bound_quantity().
using BoundComponent = std::function<ComponentBound(const Request&, const Component&,
                                                    const BoundSettings&, const TimeBudget&)>;

struct BoundSettings {
  double gap = 0.01;               ///< relative to the larger end
  std::optional<GiNaC::ex> limit;  ///< compare with it; no bracket
  SearchOptions search;            ///< its time limit is that of all components
  double forming_limit = 0;  ///< seconds to form matrices; 0: the time limit. Without its matrix a
                             ///< component has no end at all, so this may be more than its share
  OutputOptions output;
  std::string certificate;  ///< files, without their endings; empty: none
  ProofPlacing placing{};
  BracketCheckpoint* checkpoint = nullptr;
  BoundComponent over_branch{};  ///< of a model with a closure
  std::string part;  ///< of the checkpoint, if it has several quantities; otherwise empty
  const std::atomic<bool>* interrupt = nullptr;
};

/// The result for a quantity.
struct Bound {
  Quantity quantity;
  std::vector<ComponentBound> components;

  /// Returns the component with the end that decides: the largest attained or proved value (of a
  /// least value: the smallest); nullptr if a component has none.
  [[nodiscard]] const ComponentBound* decisive_attained() const;
  [[nodiscard]] const ComponentBound* decisive_proved() const;
  /// (proved − attained)/larger of the two; nullopt unless there are both.
  [[nodiscard]] std::optional<double> gap() const;
  [[nodiscard]] bool is_closed() const;
  [[nodiscard]] LimitVerdict verdict() const;
};

/// Called after each component.
using BoundListener = std::function<void(const ComponentBound&)>;

/// Bounds every component of `quantity`, one after the other.
///
/// Requires  the quantity is of request.model.
/// Throws    UsageError for options that a motion along way-points does not have; the exceptions of
///           prepare().
[[nodiscard]] Bound bound_quantity(const Request& request, Quantity quantity,
                                   const BoundSettings& settings, const BoundListener& listener);

/// Returns the ending of the files of a component's certificates: ".leg_3"; empty if it is the only
/// one.
[[nodiscard]] std::string certificate_suffix(const Component& component);

/// Throws    UsageError for --alpha, which would be ignored.
void refuse_threshold(const ModelOptions& options);

/// Returns the files of certificates that bound_quantity() writes.
[[nodiscard]] std::vector<OutputFile> certificate_files(const Quantity& quantity,
                                                        const std::string& certificate);

}  // namespace regulus::detail
