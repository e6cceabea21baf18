// SPDX-License-Identifier: Apache-2.0
// Proves leaves of a tree: of NO SINGULARITY, or of a claim about forces.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "runtime/verifier/variety.hpp"
#include "runtime/verifier/verify.hpp"
#include "runtime/verifier/work_clock.hpp"

namespace regulus::verifier {

/// The claim of one leaf.
enum class LeafClaim {
  kWhole,       ///< that of the certificate
  kInfeasible,  ///< PAVING: some wrench of the load is held by no forces
  kUndecided,   ///< PAVING: nothing
  kOutside,     ///< PAVING: no point of the leaf is in the variety
  kBranch,      ///< PAVING of a closure: the branch is regular, and nothing about forces
};

/// The numbers of a tube, as a leaf of a closure states them: x₀, c, S row by row, r.
using TubeNumbers = std::vector<double>;

struct Leaf {
  Box box;
  std::string name;  ///< for messages
  std::size_t line;
  LeafClaim claim = LeafClaim::kWhole;
  TubeNumbers tube{};  ///< of a closure, if the leaf has one
};

class Prover {
 public:
  Prover() = default;
  Prover(const Prover&) = delete;
  Prover& operator=(const Prover&) = delete;
  virtual ~Prover() = default;

  /// Forgets what earlier leaves have shown, so that the next ones are proved in the same way after
  /// any others. `looks_for_points`: a point of the variety is wanted.
  virtual void begin(bool looks_for_points) = 0;

  /// Returns if the claim holds at every point of the leaf. Throws Rejection if it is shown to be
  /// false somewhere in the variety, Unfinished if neither is shown.
  virtual void prove(const Leaf& leaf) = 0;

  /// Returns true if some part of a leaf was not outside the variety.
  [[nodiscard]] bool has_met_variety() const noexcept { return has_met_variety_; }
  /// Returns true if a point of the variety was shown to exist.
  [[nodiscard]] bool has_met_point() const noexcept { return has_met_point_; }
  /// Returns the sign of det A at some point of the variety, if one was found: a variety without
  /// constraints has one sign only.
  [[nodiscard]] int sign() const noexcept { return sign_; }
  /// Returns the number of boxes into which the leaves since begin() were cut.
  [[nodiscard]] std::uint64_t boxes() const noexcept { return boxes_; }

 protected:
  std::uint64_t boxes_ = 0;
  bool has_met_variety_ = false, has_met_point_ = false;
  int sign_ = 0;  ///< of det A at some point of a variety without constraints
};

/// Returns the prover of the question's claim. All must outlive it.
[[nodiscard]] std::unique_ptr<Prover> make_prover(Question& question, const Variety& variety,
                                                  const Options& options, WorkClock& clock);

}  // namespace regulus::verifier
