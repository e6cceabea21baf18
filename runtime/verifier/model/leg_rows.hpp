// SPDX-License-Identifier: Apache-2.0
// The rows of one leg of [legs], from its points, axis and lengths.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "runtime/verifier/rigid_motion.hpp"

namespace regulus::verifier {

enum class LegKind {
  kTelescopic,  ///< a prismatic joint between base and platform
  kCrank,       ///< a crank that turns about an axis of the base, and a rod
  kSlider,      ///< a carriage on a rail of the base, and a rod
};

struct LegType {
  std::string_view name;
  LegKind kind;
  bool is_planar, keeps_orientation, is_hinged = false;
};
/// Returns null for a word that is none.
[[nodiscard]] const LegType* find_leg_type(std::string_view word);

/// A leg as a file describes it. In the plane all third coordinates are 0, and the axis of a crank
/// is the third one.
struct LegValues {
  LegKind kind = LegKind::kTelescopic;
  bool is_planar = false;
  bool keeps_orientation = false;  ///< it holds a moment, too
  bool is_hinged = false;          ///< it holds a force, too: a revolute joint has its axis `hinge`
  int actuated = 0;                ///< the number of the joint; 0: none
  VectorNodes base{}, platform{};
  NodeId crank = kNoNode, rod = kNoNode;
  VectorNodes axis{};                 ///< of the crank, of the rail; of UPU: of the outer joints
  NodeId size = kNoNode;              ///< |axis|²
  VectorNodes bar{};                  ///< the short sides of a parallelogram
  VectorNodes hinge{};                ///< of a leg RPS at its base, of a leg PRS on its carriage
  bool has_exact_directions = false;  ///< axis and hinge are numbers: their product is 0
  VectorNodes zero{};                 ///< where a crank in space has the angle 0
  bool mode = true;
  std::optional<std::pair<NodeId, NodeId>> range{};
};

/// A row of J⁻¹ is scale·(force, moment).
struct LegRow {
  VectorNodes force{}, moment{};
  NodeId scale = kNoNode;
};

/// The leg at a pose. r = R·B, e from its first to its last joint, d along the rod.
class LegAtPose {
 public:
  /// `R`, `position`: of the platform, if it is not a point.
  LegAtPose(const LegValues& leg, const VectorNodes& position, const MatrixNodes& R,
            GraphAlgebra& algebra);

  /// The force by which the motor acts; requires  actuated ≠ 0.
  [[nodiscard]] LegRow motor();
  /// The moment of a leg that keeps the platform from turning.
  [[nodiscard]] VectorNodes moment();
  /// The force of a hinged leg, across its motor's and all twists of its passive joints.
  [[nodiscard]] LegRow hinge_force();
  /// Each ≤ 0 if the driven joint is within its range; requires  a range.
  [[nodiscard]] std::vector<NodeId> range();

  VectorNodes r{}, e{}, d{};
  NodeId rho = kNoNode;    ///< the length of an actuator
  NodeId w = kNoNode;      ///< 0 where a motor with a rod is at a dead point
  NodeId place = kNoNode;  ///< of a carriage
  NodeId off = kNoNode;    ///< 0 where the last joint is in the plane of a hinged leg

 private:
  void find_crank();
  void find_carriage();
  [[nodiscard]] LegRow force_through(const VectorNodes& point, const VectorNodes& force,
                                     NodeId scale);
  [[nodiscard]] LegRow motor_of_telescopic();
  [[nodiscard]] LegRow motor_of_crank();
  [[nodiscard]] LegRow motor_of_slider();
  [[nodiscard]] NodeId angle_range(NodeId cosine, NodeId sine, NodeId size);
  [[nodiscard]] NodeId angle_to_platform(const VectorNodes& from, NodeId size);
  [[nodiscard]] VectorNodes quarter(const VectorNodes& v);

  const LegValues& leg_;
  GraphAlgebra& g_;
  const MatrixNodes R_;
};

}  // namespace regulus::verifier
