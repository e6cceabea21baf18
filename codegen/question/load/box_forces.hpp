// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluates a kernel over eight boxes and decides about the forces there.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "codegen/question/engine/box_matrices.hpp"
#include "codegen/question/load/force_test.hpp"
#include "runtime/cluster/bytes.hpp"

namespace regulus::detail {

/// A pose of the variety, and values of the uncertain quantities, at which a load is not held.
struct ForceWitness {
  std::vector<Interval> variables;  ///< thin, or enclosing the only value
  Shortage shortage;
};

struct BoxOutcome {
  enum class Kind : std::uint8_t { kOutside, kHeld, kNotHeld, kUnknown } kind = Kind::kUnknown;
  std::optional<ForceWitness> witness{};
  bool is_hopeless = false;      ///< kUnknown: one pose of the box defeats the test
  bool is_inhabited = false;     ///< a pose of the box certainly meets the constraints
  bool is_undefined = false;     ///< kUnknown: J⁻¹ is not certainly defined all over the box
  std::vector<double> impact{};  ///< kUnknown: of each motion parameter; empty: not known
};

/// The question for a kernel of J⁻¹ with derivatives of its entries, or without.
struct ForceQuestion {
  const ForceProblem& forces;
  const Problem& problem;
  const MatrixScaling& scaling;  ///< of the kernel's matrix
};

/// A judge of boxes (runtime/search/box_judges.hpp), without a horizon. Each thread has its own.
class BoxForces {
 public:
  using Question = ForceQuestion;
  using Finding = BoxOutcome;

  explicit BoxForces(const ForceQuestion& question);
  BoxForces(const BoxForces&) = delete;
  BoxForces& operator=(const BoxForces&) = delete;

  /// Shape     boxes: 1…8 boxes, each with an interval for every variable of the kernel, the whole
  ///           one for uncertain quantities.
  /// Rounding  outward; MXCSR at nearest.
  void judge(std::span<const std::vector<Interval>> boxes, std::span<BoxOutcome> outcomes,
             double horizon);

  static void put(cluster::ByteWriter& to, const BoxOutcome& outcome);
  /// Throws    MalformedMessage.
  [[nodiscard]] static BoxOutcome take(cluster::ByteReader& from, const ForceQuestion& question);

 private:
  [[nodiscard]] BoxOutcome outcome(std::size_t lane);
  void look_at_center(std::size_t lane, const ForceDecision& decision, BoxOutcome& outcome);

  const ForceTest test_;
  BoxMatrices matrices_;
};

}  // namespace regulus::detail
