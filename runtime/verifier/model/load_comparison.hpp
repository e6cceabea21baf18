// SPDX-License-Identifier: Apache-2.0
// Which values of a model file are those of a certificate's load and limits of forces, or of its
// quantity.
#pragma once

#include <functional>

#include "runtime/verifier/model/model_file.hpp"
#include "runtime/verifier/model/section_reading.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// The steps of a comparison with a model file.
struct LoadComparer {
  /// Compares the value at a place of the file with a value that the certificate states; a value that
  /// it does not state is 0.
  std::function<void(const std::string& place, const std::string& stated)> compare;
  /// A value that the certificate states has been compared, as a part of others.
  std::function<void(const std::string& stated)> note;
  /// A place of the file cannot be compared.
  std::function<void(const std::string& place)> leave_out;
  /// The certificate states a value that the file does not have. Throws OtherModel.
  std::function<void(const std::string& stated)> refuse;
  /// The certificate states no value of a row, and the file has one. Throws OtherModel.
  std::function<void(const std::string& key, std::size_t row)> refuse_row;
  /// Returns true if the stated value has been compared or noted.
  std::function<bool(const std::string& stated)> is_compared;
  /// The section that describes the robot; may be null.
  const SectionReading* section = nullptr;
};

/// Compares every value of [actuators] force and of [load.NAME]. For a range it adds its ends,
/// "wrench-lower 0" and "wrench-upper 0", to the stated values. Returns false if there is no such
/// load in the file.
[[nodiscard]] bool compare_load(Question& question, const WrittenValues& values,
                                const LoadComparer& comparer);

/// Compares every value of [load.NAME] or [twist.NAME], of [actuators] error and stiffness, and
/// characteristic_length, if the quantity of the claim depends on it. Returns the same.
[[nodiscard]] bool compare_quantity(Question& question, const WrittenValues& values,
                                    const LoadComparer& comparer);

}  // namespace regulus::verifier
