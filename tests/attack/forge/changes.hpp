// SPDX-License-Identifier: GPL-3.0-or-later
// One change of a certificate or of a model file, at random.
#pragma once

#include <string>

#include "tests/attack/oracle/random.hpp"

namespace regulus::detail::attack {

struct Change {
  std::string text;  ///< the whole file, changed
  std::string what;  ///< "line 12: 'entry x' -> 'entry x + 1'"
};

/// Changes lines of a certificate: one of the question, several in the same way, all of a kind, a
/// condition to have a value, or the frame around the question.
[[nodiscard]] Change change_certificate(const std::string& certificate, Random& random);

/// Changes a number, a name, a word or a line of a model file.
[[nodiscard]] Change change_model(const std::string& model, Random& random);

/// Changes a number or a line of a file of way-points.
[[nodiscard]] Change change_waypoints(const std::string& waypoints, Random& random);

}  // namespace regulus::detail::attack
