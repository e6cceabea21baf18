// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluates a kernel over eight boxes and decides about the forces there.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "codegen/feasibility/force_test.hpp"
#include "codegen/formulation/scaling.hpp"
#include "runtime/interval/lanes.hpp"
#include "runtime/kernel/call.hpp"
#include "runtime/problem/problem.hpp"
#include "runtime/regularity/aligned_buffer.hpp"

namespace regulus::inline feasibility {

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

/// Each thread has its own.
class BoxForces {
 public:
  explicit BoxForces(const ForceQuestion& question);

  /// Shape     boxes: 1…8 boxes, each with an interval for every variable of the kernel, the whole
  ///           one for uncertain quantities.
  /// Rounding  outward; MXCSR at nearest.
  [[nodiscard]] std::vector<BoxOutcome> decide(std::span<const std::vector<Interval>> boxes);

 private:
  using Box = std::vector<Interval>;

  void load(AlignedBuffer& to, std::size_t lane, std::span<const Interval> box) const;
  /// Returns the lanes in which the function is defined.
  LaneMask call(regulus_function function, const AlignedBuffer& boxes, AlignedBuffer& out) const;
  void evaluate(std::span<const Box> boxes);
  [[nodiscard]] Interval center_of(const Interval& x, std::size_t variable) const;
  [[nodiscard]] Box nominal_point(const Box& center) const;
  [[nodiscard]] std::vector<Interval> entries(const AlignedBuffer& values, std::size_t lane,
                                              std::size_t matrix) const;
  [[nodiscard]] BoxMatrix matrix_of(const Box& box, std::size_t lane) const;
  [[nodiscard]] BoxOutcome outcome(const Box& box, std::size_t lane);
  void look_at_center(std::size_t lane, const ForceDecision& decision, BoxOutcome& outcome);
  /// Removes the lanes in which some constraint may be positive.
  [[nodiscard]] LaneMask certain_inside(LaneMask lanes) const;

  const ForceQuestion question_;
  const Kernel kernel_;
  const std::size_t variables_, parameters_, entries_;
  const ForceTest test_;
  std::vector<Box> centers_;
  AlignedBuffer boxes_, center_boxes_, points_;
  AlignedBuffer center_values_, slopes_, point_values_, constraints_;
  LaneMask center_defined_ = 0, slopes_defined_ = 0, point_defined_ = 0, outside_ = 0, inside_ = 0;
};

}  // namespace regulus::feasibility
