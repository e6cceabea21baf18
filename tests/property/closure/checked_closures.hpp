// SPDX-License-Identifier: GPL-3.0-or-later
// Asks about closures that tests write, and has the answers verified.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "codegen/model/file/model_file.hpp"
#include "codegen/question/closure/closure_certificate.hpp"
#include "codegen/question/closure/closure_report.hpp"
#include "runtime/verifier/verify.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {

inline SearchOptions usual_options() {
  SearchOptions search;
  search.engine = Engine::kInterpreted;
  search.threads = 1;
  search.time_limit = 60;
  return search;
}

struct CheckedClosure {
  PreparedClosure prepared;
  ClosureFinding found;
  [[nodiscard]] Verdict verdict() const { return check_result(prepared, found).verdict; }
};

/// Checks the motion `m` of a model.
inline CheckedClosure check_closure_text(const std::string& text, const SearchOptions& search) {
  ModelOptions options;
  options.motion = "m";
  CheckedClosure checked{prepare_closure(read_request(text, options), 0, search, {}), {}};
  checked.found = check_closure(checked.prepared, search, {});
  return checked;
}

/// Returns the certificate; empty if nothing is proved.
inline std::string certified_closure(const CheckedClosure& checked) {
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "certificate").string();
  const ProofStatus status = certify_check(path, checked.prepared, checked.found, {});
  std::ostringstream text;
  if (status.is_written()) text << std::ifstream(path).rdbuf();
  return text.str();
}

inline verifier::Verification verified(const std::string& certificate,
                                       const std::string& model = "") {
  verifier::Options options;
  options.model_text = model;
  options.model_name = "model.toml";
  std::istringstream stream(certificate);
  return verifier::verify(stream, options);
}

/// The 3-RPR of ALIAS by its legs.
inline std::string rpr(const std::string& motion) {
  return "regulus = 1\nname = \"3-RPR\"\n[pose]\nl1 = \"cm\"\nl2 = \"cm\"\nl3 = \"cm\"\n"
         "[let]\nb2x = \"x + 4*cos(phi) - 10\"\nb2y = \"y + 4*sin(phi)\"\n"
         "b3x = \"x + 2*cos(phi) - 2*sin(phi) - 3\"\nb3y = \"y + 2*sin(phi) + 2*cos(phi) - 10\"\n"
         "[closure]\nunknowns = { x = \"cm\", y = \"cm\", phi = \"rad\" }\n"
         "equations = [\"x^2 + y^2 - l1^2\", \"b2x^2 + b2y^2 - l2^2\", \"b3x^2 + b3y^2 - l3^2\"]\n"
         "start = { l1 = \"sqrt(50)\", l2 = \"sqrt(26)\", l3 = 5, x = 5, y = 5, phi = 0 }\n"
         "[motion.m]\n" +
         motion;
}

}  // namespace regulus::detail::test
