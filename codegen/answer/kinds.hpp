// SPDX-License-Identifier: GPL-3.0-or-later
// The answers with the data of their kind, for programs that take values and not reports.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/answer/answer.hpp"
#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/question/load/force_claim.hpp"
#include "codegen/question/solve/solutions.hpp"
#include "runtime/interval/interval.hpp"
#include "runtime/problem/result.hpp"
#include "runtime/search/paving.hpp"

namespace regulus::detail {

/// A proof of an end of a bracket: the file, or the reason why there is none.
struct ProofOfEnd {
  std::string component;  ///< "leg 3"; empty: the only one
  bool is_safe_end = true;
  std::string file, obstacle;
};

/// Returns Answer::missing_proof().
[[nodiscard]] std::string missing_proof(const ProofStatus& proof);
[[nodiscard]] std::string missing_proof(const std::vector<ProofOfEnd>& proofs);

/// Has the motion a singular pose?
class CheckAnswer : public Answer {
 public:
  Result result;                       ///< in the order of `variables`
  std::vector<std::string> variables;  ///< motion parameters, then uncertain quantities
  ProofStatus proof;

  [[nodiscard]] virtual std::string claim() const = 0;
  [[nodiscard]] Word word() const override;
  [[nodiscard]] std::string headline() const override;
  [[nodiscard]] std::string missing_proof() const override { return detail::missing_proof(proof); }
};

/// A part of a motion along way-points, as PathStretch, with its JSON line.
template <class WhatIsClaimed>
struct StretchWith {
  WhatIsClaimed claim = WhatIsClaimed::kUndecided;
  std::size_t first_segment = 1, last_segment = 1;  ///< from 1
  double begin = 0, end = 1;  ///< the places, as parts of the first and of the last segment
  std::string line;
};
using StretchOfWay = StretchWith<Claim>;
using StretchOfLoad = StretchWith<ForceClaim>;

/// Where has it one?
class PavingAnswer : public Answer {
 public:
  Result result;
  std::vector<std::string> variables;
  ProofStatus proof;
  /// Bounds of the part of the motion's box with each claim, in the order of Claim; [0, 1] along
  /// way-points.
  Interval free{0, 1}, singular{0, 1}, undecided{0, 1}, outside{0, 1}, unreachable{0, 1};
  Interval workspace{1.0};              ///< the part that meets the constraints
  std::vector<StretchOfWay> stretches;  ///< along way-points: in order, without gaps

  /// Returns the first JSON line of the boxes; null along way-points.
  [[nodiscard]] virtual nlohmann::ordered_json header() const = 0;
  [[nodiscard]] Word word() const override;
  [[nodiscard]] std::string headline() const override;
  [[nodiscard]] std::string missing_proof() const override { return detail::missing_proof(proof); }
};

/// How far can a tolerance, the threshold or a size grow?
class MarginAnswer : public Answer {
 public:
  std::optional<std::string> safe;     ///< the largest value that is certified
  std::optional<std::string> refuted;  ///< the least value with a witness
  bool is_of_limit = false;            ///< of a quantity, not of regularity
  bool closed = false;                 ///< as narrow as wanted
  std::vector<ProofOfEnd> proofs;

  [[nodiscard]] std::string missing_proof() const override { return detail::missing_proof(proofs); }
};

/// What is the largest or least value of a quantity?
class BoundAnswer : public Answer {
 public:
  enum class Verdict { kBracket, kWithin, kExceeded, kUndecided };
  Verdict verdict = Verdict::kBracket;  ///< of the limit
  /// The value that is attained, rounded so that it claims no more than it should, and the value
  /// that is proved not to be passed, rounded away from it.
  std::optional<double> attained, proved;
  bool closed = false;
  std::string unit;
  std::vector<ProofOfEnd> proofs;

  [[nodiscard]] std::string missing_proof() const override { return detail::missing_proof(proofs); }
};

/// Do forces within the limits hold a load?
class LoadAnswer : public Answer {
 public:
  FeasibilityVerdict verdict = FeasibilityVerdict::kPossibleProblem;
  std::string claim, reason;  ///< one of them is empty
  std::vector<std::string> variables;
  std::uint64_t boxes = 0;
  ProofStatus proof;

  [[nodiscard]] Word word() const override;
  [[nodiscard]] std::string headline() const override;
  [[nodiscard]] std::string missing_proof() const override { return detail::missing_proof(proof); }
  [[nodiscard]] std::string about_files() const override { return proof.line(); }
};

/// Where do they?
class LoadPavingAnswer : public LoadAnswer {
 public:
  /// Bounds of the part of the motion's box with each claim; [0, 1] along way-points.
  Interval feasible{0, 1}, infeasible{0, 1}, undecided{0, 1}, outside{0, 1};
  std::vector<StretchOfLoad> stretches;  ///< along way-points: in order, without gaps
};

/// Asks for all solutions.
class SolveAnswer : public Answer {
 public:
  Solutions solutions;                ///< at the only place
  std::vector<SolvedPlace> places{};  ///< empty: there is only one
  std::uint64_t places_left = 0;      ///< that were not asked any more
  SolvedNoun noun;
  ProofStatus proof;  ///< of the solutions at one place, or at all

  [[nodiscard]] Word word() const override;
  [[nodiscard]] std::string headline() const override;
  [[nodiscard]] std::string missing_proof() const override { return detail::missing_proof(proof); }

 protected:
  bool has_places_ = false;
};

class DatasheetAnswer : public Answer {
 public:
  std::vector<ProofOfEnd> proofs;  ///< of all quantities, in order

  [[nodiscard]] std::string missing_proof() const override { return detail::missing_proof(proofs); }
};

/// Returns the word of a verdict.
[[nodiscard]] Word word_of(Verdict verdict) noexcept;
[[nodiscard]] Word word_of(FeasibilityVerdict verdict) noexcept;

}  // namespace regulus::detail
