// SPDX-License-Identifier: Apache-2.0
// What a section of a model file, [gough], [legs] or [serial], says of the robot, as nodes of the
// question's graph. The reader of each section is the verifier's own.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/verifier/model/equality.hpp"
#include "runtime/verifier/model/model_file.hpp"
#include "runtime/verifier/question.hpp"
#include "runtime/verifier/rigid_motion.hpp"

namespace regulus::verifier {

/// A part of a model file: "legs.leg[0].rod", its line, and the text that a message shows.
struct FilePlace {
  std::string place;
  std::size_t line = 0;
  std::string text;
};

/// The steps of a comparison that the readers of sections use. What differs throws OtherModel, with
/// both texts and lines. What cannot be compared is kept, and makes the answer UNFINISHED.
class SectionComparer {
 public:
  virtual ~SectionComparer() = default;

  [[nodiscard]] virtual Question& question() = 0;
  [[nodiscard]] virtual const WrittenValues& values() const = 0;
  /// Returns the place of a value that the file has.
  [[nodiscard]] virtual FilePlace place_of(const std::string& place) const = 0;

  /// Returns the expression at a place of the file, with the names of `scope` (Question::actual or
  /// Question::commanded), of [let] and of the section. Throws Unfinished or Rejection if it cannot.
  [[nodiscard]] virtual NodeId expression_at(const std::string& place, const Scope& scope) = 0;

  /// Compares a value of the file with what the certificate states under a key of Question::stated:
  /// "value a1_x", "spread a1_x", "entry 0", "scale 0". A spread that is not stated is 0; any other
  /// value that is not stated differs. `option`: the option that may have changed it, as in
  /// Options::overridden; "" for none.
  virtual void compare(const FilePlace& from, NodeId value, const std::string& stated,
                       const std::string& option) = 0;
  /// The same, without an option.
  void compare(const FilePlace& from, NodeId value, const std::string& stated) {
    compare(from, value, stated, "");
  }
  /// These constants, by name, are the coordinates of a point in a ball; its radius is their spread.
  virtual void expect_ball(const FilePlace& from, const std::vector<std::string>& names) = 0;
  /// The model means nothing where an operation of this expression has no value. The certificate must
  /// state so, in an entry or in a line `defined`. What is compared as an entry or as a constant is
  /// expected to be defined without this call; a scale is not.
  virtual void expect_defined(const FilePlace& from, NodeId value) = 0;
  /// A value has been compared in another way, or what the certificate states under this key follows
  /// from values that have been.
  virtual void note_compared(const std::string& stated) = 0;
  /// The comparison of a part of the file, or of what the certificate states, is not possible.
  virtual void leave_out(const FilePlace& from, const std::string& why) = 0;
  /// Throws OtherModel: the file has this, and the certificate has something else.
  [[noreturn]] virtual void refuse(const FilePlace& from, const std::string& stated) = 0;
};

/// A pose parameter and its unit.
struct SectionPose {
  std::string name, unit;
};

/// An anchor, and the list of its coordinates in the file.
struct SectionPoint {
  std::string place;
  VectorNodes value{};
};

/// A joint of an arm that moves.
struct SectionJoint {
  std::string name;  ///< its own, or that of its leader
  bool slides = false;
  PlacementNodes origin{};  ///< of its frame in that of the joint before, all joints at 0
  VectorNodes axis{};       ///< through the origin of its frame; of length 1
  NodeId value = kNoNode;   ///< by the pose of Question::actual; an angle in radians
  std::string range{};      ///< its place in the file; "": it has none
  /// Of a joint that follows another, its leader, by its number among all: the value is multiplier times that
  /// one's, and the offset; angles in radians.
  std::optional<std::size_t> leader{};
  NodeId multiplier = kNoNode, offset = kNoNode;
  bool is_of_tool = false;  ///< it is no joint: the tool may be turned about its z axis
};

/// An arm without its tolerances; the frame of the tool is that in the frame of the last joint.
struct SectionArm {
  std::vector<SectionJoint> joints;
  PlacementNodes tool{};
};

/// A leg of variable length, from the base to the platform.
struct SectionLeg {
  SectionPoint base, platform;
};

class SectionReading {
 public:
  virtual ~SectionReading() = default;

  /// Returns the pose parameters, in their order.
  [[nodiscard]] virtual std::vector<SectionPose> pose() const = 0;

  /// Returns the meaning of a name that the section declares for expressions of the file, such as
  /// rho_1 of [legs], by the pose of `scope`; kNoNode: it has no such name.
  [[nodiscard]] virtual NodeId name(std::string_view, const Scope&, SectionComparer&) {
    return kNoNode;
  }
  /// Returns the number of motors, whose rows come first; nullopt: each row is one's.
  [[nodiscard]] virtual std::optional<std::size_t> motors() const { return std::nullopt; }
  /// Returns what where = "within-ranges" adds to the constraints, in the order of the certificate's
  /// lines: each is ≤ 0, by the commanded pose. nullopt: this reader does not know.
  [[nodiscard]] virtual std::optional<std::vector<NodeId>> range_constraints(SectionComparer&) {
    return std::nullopt;
  }
  /// Returns the place of the file that gives the range or the value of a pose parameter in a motion
  /// that the section makes ("serial.joints[0].range"); "": it makes no such motion.
  [[nodiscard]] virtual std::string place_in_motion(const std::string& /*motion*/,
                                                    const std::string& /*pose*/) const {
    return "";
  }

  /// Returns the legs of variable length, if the robot is a platform in space on such legs alone.
  /// Throws Unfinished if it is not. Names of constants mean those of Question::actual.
  [[nodiscard]] virtual std::vector<SectionLeg> telescopic_legs(SectionComparer&) {
    throw Unfinished("the file describes no platform on legs of variable length");
  }
  /// Returns the same anchors with their tolerances, by the constants of the certificate. Compares these
  /// with their spreads and balls.
  [[nodiscard]] virtual std::vector<SectionLeg> uncertain_legs(SectionComparer&) {
    throw Unfinished("the file describes no platform on legs of variable length");
  }
  /// Returns the squared length of such a leg at the pose of `scope`.
  [[nodiscard]] virtual NodeId squared_length(const SectionLeg&, const Scope& /*pose*/,
                                              SectionComparer&) {
    throw Unfinished("the file describes no platform on legs of variable length");
  }

  /// Returns the arm. Throws Unfinished if the robot is none.
  [[nodiscard]] virtual SectionArm arm(SectionComparer&) {
    throw Unfinished("the file describes no arm");
  }

  /// Compares every constant with its spread, every ball, entry and scale, and says what must be
  /// defined.
  virtual void compare(SectionComparer& comparer) = 0;
};

/// Returns the reader of the section that describes the robot; nullptr if the file has none of
/// [gough], [legs] and [serial], or if no reader knows that section.
[[nodiscard]] std::unique_ptr<SectionReading> read_section(const WrittenValues& values);

}  // namespace regulus::verifier
