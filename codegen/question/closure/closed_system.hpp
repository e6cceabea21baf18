// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of a closure and their derivatives, as the matrix of a kernel.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "codegen/model/request.hpp"
#include "codegen/question/engine/box_matrices.hpp"
#include "codegen/question/engine/report_labels.hpp"

namespace regulus::detail {

/// The sizes of a system. The variables of its kernel are those of a certificate, in its order
/// (motion parameters, uncertain quantities, control errors), and after them the unknowns.
struct ClosedShape {
  std::size_t parameters = 0;      ///< of the motion
  std::size_t variables = 0;       ///< with the uncertain ones
  std::size_t unknowns = 0;        ///< with those of DerivativesBy::kVariablesAndNominal
  std::size_t differentiated = 0;  ///< variables with derivatives in the matrix: all or none
  std::size_t driven = 0;          ///< pose parameters with derivatives in it: all or none
};

/// The derivatives that a system forms, beside those by the unknowns.
///
/// kVariablesAndNominal: those by variables, of a system with each unknown and each equation once
/// more. The copies are of the mechanism without errors: there the uncertain quantities have the
/// middles of their ranges, and control errors are 0.
enum class DerivativesBy { kUnknowns, kVariables, kVariablesAndPose, kVariablesAndNominal };

struct ClosedSystem {
  ClosedShape shape;
  /// A motion in a box of all variables. Its matrix has the equations in its first row, and in the
  /// row of each unknown, and then of each variable and of each pose parameter if it has them, their
  /// derivatives by it.
  Request request;
  std::vector<VariableLabel> labels;  ///< of the variables
};

/// `constants`: the variables of the kernel after the unknowns. A Problem gives each a value.
///
/// Requires  request.model.closure; no motion along way-points.
/// Throws    UsageError if an equation has atan2: it may jump, and its derivatives do not show it.
[[nodiscard]] ClosedSystem close(const Request& request,
                                 DerivativesBy by = DerivativesBy::kVariables,
                                 const std::vector<PoseParameter>& constants = {});

/// Evaluates a system over eight boxes at once. Each thread has its own.
class SystemBoxes {
 public:
  using Box = BoxMatrices::Box;

  struct System {
    std::vector<Interval> value;        ///< n
    std::vector<Interval> by_unknown;   ///< n×n, row-major
    std::vector<Interval> by_variable;  ///< n×m, row-major; empty of a system without them
    /// Their derivatives by each variable and then by each unknown, as in TubeSystem; by each
    /// unknown alone of a system without derivatives by variables.
    std::vector<Interval> rates_by_unknown{}, rates_by_variable{};
    std::vector<Interval> by_pose{};  ///< n×d, row-major; empty of a system without them
  };

  /// The objects must outlive this one. The variables of the problem beyond those of the shape are
  /// constants, with the problem's values.
  SystemBoxes(const Problem& problem, const MatrixScaling& scaling, const ClosedShape& shape);

  /// `has_rates`: with the derivatives of the derivatives.
  ///
  /// Shape     1…8 boxes, each with an interval for every variable and then every unknown.
  /// Rounding  outward; MXCSR at nearest.
  void evaluate(std::span<const Box> boxes, bool has_rates = false);
  /// Returns nullopt if an expression is not certainly defined all over the box of that lane.
  [[nodiscard]] std::optional<System> at(std::size_t lane) const;

  /// Returns for each of 1…8 boxes if some constraint excludes it. Forgets the boxes.
  [[nodiscard]] std::vector<char> are_outside(std::span<const Box> boxes);
  /// Returns if a point certainly meets the constraints, and the system is defined there. Forgets the
  /// boxes.
  [[nodiscard]] bool is_certain(const Box& point) {
    const Box all = with_constants(point);
    return boxes_.at({&all, 1}).front().has_value();
  }

 private:
  [[nodiscard]] Box with_constants(Box box) const {
    box.insert(box.end(), constants_.begin(), constants_.end());
    return box;
  }
  void take(std::span<const Interval> entries, std::vector<Interval>& by_unknown,
            std::vector<Interval>& by_variable) const;

  const ClosedShape shape_;
  const Box constants_;
  BoxMatrices boxes_;
  bool has_rates_ = false;
};

}  // namespace regulus::detail
