// SPDX-License-Identifier: Apache-2.0
// The program coqc, with the library of theorems, in a folder of its own: neither the folder of the
// user nor the user's settings and libraries have a part in what it reads.
#pragma once

#include <stdexcept>
#include <string>

#include "runtime/files/temporary.hpp"

namespace regulus::verifier {

/// Coq did not end within the time limit.
class CoqTimeout : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns the folder of the compiled library: `named`, or else that of the environment variable
/// REGULUS_FORMAL, or else that beside this program. Throws std::runtime_error, with what to do.
[[nodiscard]] std::string find_coq_library(const std::string& named);

class Coqc {
 public:
  /// `time_limit`: in seconds, of all calls together; 0: none.
  Coqc(std::string library, double time_limit);

  struct Answer {
    bool is_accepted = false;
    std::string text;  ///< what coqc printed
  };

  /// Compiles the text as the file NAME.v of the folder. Throws CoqTimeout, std::runtime_error.
  Answer compile(const std::string& name, const std::string& text);

 private:
  const std::string library_;
  const double end_;  ///< on the steady clock; 0: none
  detail::TemporaryFolder folder_;
};

}  // namespace regulus::verifier
