// SPDX-License-Identifier: Apache-2.0
// Which values of a model file are those of a certificate's load and limits of forces.
#pragma once

#include <functional>

#include "runtime/certificate/verifier/model_file.hpp"
#include "runtime/certificate/verifier/question.hpp"

namespace regulus::verifier {

/// Compares the value at a place of the file with a value that the certificate states.
using CompareValue = std::function<void(const std::string& place, const std::string& stated)>;

/// Calls `compare` for every value of [actuators] force and of [load.NAME]. For a range it adds its
/// ends, "wrench-lower 0" and "wrench-upper 0", to the stated values, and calls `note` with the
/// middle and the spread, which follow from them.
void compare_load(Question& question, const WrittenValues& values, const CompareValue& compare,
                  const std::function<void(const std::string& stated)>& note);

}  // namespace regulus::verifier
