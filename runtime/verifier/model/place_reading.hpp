// SPDX-License-Identifier: Apache-2.0
// Reads the robot's constants and the motion's values, for all comparisons of places with a model file.
#pragma once

#include "runtime/verifier/model/question_comparer.hpp"

namespace regulus::verifier {

class PlaceReading {
 protected:
  /// `section`: is not null. All must outlive this object.
  PlaceReading(QuestionComparer& comparer, SectionReading* section)
      : comparer_(comparer),
        q_(comparer.question()),
        values_(comparer.values()),
        section_(section),
        motion_("motion." + q_.motion + '.') {}

  [[nodiscard]] bool has(const std::string& place) const { return values_.contains(place); }
  [[nodiscard]] bool starts(WrittenValues::const_iterator at, std::string_view with) const {
    return at != values_.end() && at->first.starts_with(with);
  }
  /// The constants of [geometry] have their values, whatever their tolerances are.
  void name_constants();
  /// Returns the value of a pose parameter in the motion, which may be a range from a number to the same;
  /// kNoNode: it has none.
  [[nodiscard]] NodeId value_of(const std::string& pose);
  /// `what`: the file says, and not that of the certificate.
  void require_place_option(const std::string& what);
  /// The claim is about one robot.
  void require_no_tolerances();
  /// A threshold is no part of the claim.
  void require_known_keys();

  QuestionComparer& comparer_;
  Question& q_;
  const WrittenValues& values_;
  SectionReading* const section_;
  const std::string motion_;  ///< "motion.NAME."
};

}  // namespace regulus::verifier
