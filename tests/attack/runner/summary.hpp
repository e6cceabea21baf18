// SPDX-License-Identifier: GPL-3.0-or-later
// Counts the outcomes by family, and lists the failures.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/attack/runner/outcome.hpp"

namespace regulus::detail::attack {

struct FamilyCount {
  std::map<Truth, std::uint64_t> truths;
  std::map<int, std::uint64_t> exits;  ///< of models that returned
  std::map<Judgement, std::uint64_t> judgements;
  std::map<Proof, std::uint64_t> proofs;
  std::uint64_t announced = 0;  ///< unfinished proofs that the report announced
  std::uint64_t slow_proofs = 0;
  double seconds = 0, slowest = 0;
  std::uint64_t slowest_seed = 0;
};

/// A model that deserves a closer look.
struct Failure {
  std::string what;  ///< "CONTRADICTION", "REJECTED", "UNFINISHED, announced"
  std::string family;
  std::uint64_t seed = 0;
  std::string detail;
};

class Summary {
 public:
  void add(const Attack& attack, const Outcome& outcome);

  [[nodiscard]] const std::map<std::string, FamilyCount>& families() const { return families_; }
  /// Returns the failures, and also slow runs and unfinished proofs, which failed() ignores.
  [[nodiscard]] const std::vector<Failure>& failures() const { return failures_; }
  [[nodiscard]] std::uint64_t count(Judgement judgement) const;
  [[nodiscard]] std::uint64_t count(Proof proof) const;
  [[nodiscard]] std::uint64_t models() const;
  /// Returns the number of checks and proofs that were stopped at the time limit.
  [[nodiscard]] std::uint64_t slow() const;
  /// Returns the number of unfinished proofs of which the report did not warn.
  [[nodiscard]] std::uint64_t unannounced() const;
  /// Returns the part of all proofs that are verified, 0 to 100; 100 if there are no proofs.
  [[nodiscard]] double verified_percent() const;
  /// Returns true for a contradiction, crash, rejected proof or broken verifier, not for slowness.
  [[nodiscard]] bool failed() const;

  [[nodiscard]] std::string table() const;
  /// Returns a line for each, with the command that shows it; up to `most` of each kind and family.
  [[nodiscard]] std::string failure_lines(const std::string& program, std::size_t most) const;
  [[nodiscard]] std::string json() const;

 private:
  void add_unfinished(const Attack& attack, const Outcome& outcome);
  void note(const std::string& what, const Attack& attack, const std::string& detail);

  std::map<std::string, FamilyCount> families_;
  std::vector<Failure> failures_;
  std::map<std::string, std::uint64_t> unfinished_;  ///< by reason
};

}  // namespace regulus::detail::attack
