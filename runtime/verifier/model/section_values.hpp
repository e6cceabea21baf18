// SPDX-License-Identifier: Apache-2.0
// The numbers of a section of a model file: constants, angles, and quantities with a tolerance.
#pragma once

#include "runtime/verifier/model/section_reading.hpp"
#include "runtime/verifier/rigid_motion.hpp"

namespace regulus::verifier {

/// The tolerance of the quantities of one kind: its key, and the option that changes it.
struct SectionTolerance {
  std::string key, option;
  bool is_angle = false;
};

/// A point or a length of a file: the place of its value, { value = …, tolerance = E } or the value
/// alone, and the tolerance that it has.
struct SectionQuantity {
  std::string value;
  SectionTolerance tolerance;
  bool has_own_tolerance = false, is_ball = false;
};

/// `shared`: the tolerance of all quantities of its kind, of points in balls if `are_balls`.
[[nodiscard]] SectionQuantity section_quantity(const WrittenValues& values,
                                               const std::string& place,
                                               const SectionTolerance& shared,
                                               bool are_balls = false);

class SectionValues {
 public:
  /// `in_degrees`: numbers of angles are degrees.
  SectionValues(SectionComparer& comparer, bool in_degrees)
      : comparer_(comparer), algebra_(comparer.question().graph), in_degrees_(in_degrees) {}

  /// Returns a value that does not depend on the pose. Throws Unfinished if there is none.
  [[nodiscard]] NodeId constant(const std::string& place);
  /// Returns a point without its tolerance, with 0 for what lacks in the plane. Throws Unfinished if
  /// there is none.
  [[nodiscard]] SectionPoint middle(const std::string& place, std::size_t axes = 3);
  /// Returns an angle in its own unit, which may be degrees.
  [[nodiscard]] NodeId number_of_angle(const std::string& place);
  /// Returns an angle in radians.
  [[nodiscard]] NodeId angle(const std::string& place);
  /// Returns an angle in its unit as an angle in radians.
  [[nodiscard]] NodeId in_radians(NodeId angle) {
    return in_degrees_ ? algebra_.degrees(angle) : angle;
  }

  /// Returns a quantity, and compares it with the constant `name` of the certificate, or its error with
  /// `name`_error, which varies about 0. Adds the name to `names`, if it is not null. What the
  /// certificate does not state must have no tolerance.
  [[nodiscard]] NodeId quantity(const std::string& place, const std::string& name,
                                const SectionTolerance& tolerance,
                                std::vector<std::string>* names = nullptr);

 private:
  NodeId checked(const std::string& place, NodeId node);
  void compare_spread(const std::string& name, const SectionTolerance& tolerance);

  SectionComparer& comparer_;
  GraphAlgebra algebra_;
  const bool in_degrees_;
};

}  // namespace regulus::verifier
