// SPDX-License-Identifier: GPL-3.0-or-later
// What a report says about the certificates of a bracket.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace regulus::inline bracketing {

/// The certificate of one end. `words` say what it proves; without a file, why there is none.
struct EndProof {
  std::string file;
  std::string words;
};

struct EndProofs {
  bool wanted = false;
  EndProof safe, singular;
  const char* safe_name = "safe";  ///< for people
  const char* singular_name = "singular";

  /// Returns a line of the report for each end; empty if none was wanted.
  [[nodiscard]] std::string lines() const;
  /// Adds the key `certificates`, with the file of each end or null, and `certificate_obstacles`,
  /// with the reason for each end without a file. Adds nothing if none was wanted.
  void add_to(nlohmann::ordered_json& report) const;
};

}  // namespace regulus::bracketing
