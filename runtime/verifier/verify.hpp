// SPDX-License-Identifier: Apache-2.0
// Reads a certificate and proves its claim anew.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <istream>
#include <set>
#include <string>
#include <vector>

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

enum class Outcome {
  kVerified,    ///< the claim is true
  kRejected,    ///< not a certificate, incomplete, or its claim has been shown to be false
  kUnfinished,  ///< neither has been shown
};

struct Verification;
struct ShardProof;

struct Options {
  unsigned threads = 1;  ///< that prove leaves
  /// The path of the file: the shards of an index are beside it. Empty: an index is refused.
  std::string path;
  /// This process proves one shard of the index in every `parts`, from number `part` on.
  std::size_t part = 0, parts = 1;
  /// Completes the list of shards with those that other processes have proved. Needed if there are
  /// several parts.
  std::function<void(std::vector<ShardProof>&)> exchange;
  std::uint64_t max_boxes = 1 << 22;  ///< into which all leaves together may be cut
  std::uint64_t max_boxes_per_leaf = 1 << 16;
  long max_bits = 4096;   ///< if doubles do not decide the sign of a determinant
  double time_limit = 0;  ///< in seconds; 0: none
  std::uint64_t max_bytes = format::kMaxBytes;  ///< of the file
  /// The text and name of the model file that the question must be about; empty: any.
  std::string model_text, model_name;
  /// For a comparison with the model file: the table of way-points that a trajectory follows; empty:
  /// that of its motion, which is beside `model_name`.
  std::string waypoints;
  /// For a comparison with the model file: values that may differ because an option of the command
  /// line has set them: "alpha", "range x", "tolerance base".
  std::set<std::string> overridden;
  bool all_overridden = false;  ///< every such value may differ
  std::set<std::string> fixed;  ///< those that may not: a table gives them
  /// Called a few times a second with the counts so far; not called if empty.
  std::function<void(const Verification&)> progress;
};

/// The claims of a paving's leaves, in the order of LeafClaim.
inline constexpr std::array kPavedWords{format::kFeasibleLeaf, format::kInfeasibleLeaf,
                                        format::kUndecidedLeaf, format::kOutsideLeaf,
                                        format::kTubeLeaf};

struct Verification {
  Outcome outcome = Outcome::kUnfinished;
  std::string reason;  ///< of kRejected and kUnfinished
  std::string claim;   ///< empty if it could not be read
  std::string bound;   ///< the number of a bound as a decimal, or that the claim has none
  std::string model, sha256, motion;
  std::size_t pieces = 0;  ///< of a trajectory, or sides of cuts of atan2; 0: there are none
  bool are_sides = false;
  std::size_t places = 0;  ///< of a table, each with its own proof; 0: the claim is about one
  std::size_t shards = 0;  ///< of an index; 0: the proof is in one file
  std::uint64_t leaves = 0;
  std::uint64_t boxes = 0;                                ///< into which the leaves were cut
  std::array<std::uint64_t, kPavedWords.size()> paved{};  ///< of a paving: its leaves by claim
  std::uint64_t links = 0;               ///< of a closure: pairs of leaves of one branch
  std::size_t roots = 0;                 ///< of a count: complex solutions that are proved
  std::size_t real_roots = 0;            ///< real ones among them
  std::size_t numbers = 0;               ///< values of the model file that were compared
  std::vector<std::string> differences;  ///< those that options have set to other values
  std::string note;                      ///< more information about a claim that was verified
};

/// The part of a proof that one shard holds.
struct ShardProof {
  bool is_proved = false;
  bool is_rejected = false;  ///< otherwise, and if it is not proved, it is unfinished
  std::string reason;        ///< if it is not proved
  std::string question;      ///< its SHA-256
  std::uint64_t leaves = 0;
  std::uint64_t boxes = 0;       ///< into which the leaves were cut
  std::string before, after;     ///< the boxes that wait at its beginning and at its end, as text
  std::string lines;             ///< of a branch: the SHA-256 of its lines after `proof`
  bool has_met_variety = false;  ///< some leaf was not outside the constraints
  bool has_met_point = false;    ///< a point of the set was shown to exist
  int sign = 0;                  ///< of det A at a point of the set, if one is known
  std::array<std::uint64_t, kPavedWords.size()> paved{};  ///< as Verification::paved
  // The shard may be about places of a table. Then `about` has model, SHA-256 and motion, `differences` is
  // as Verification::differences, and `of_places` counts those that are complete, have none, are
  // incomplete, then solutions, roots, real roots and numbers.
  std::vector<std::string> about{}, differences{};
  std::vector<std::uint64_t> of_places{};
  bool is_of_other_model = false;  ///< and so rejected
};

/// Ensures   kVerified only if the claim of the file is true (PROOF.md). Uses the usual
///           floating-point environment, and restores the caller's. Throws nothing but
///           std::bad_alloc, and std::runtime_error if the file cannot be read, or if the processor
///           does not round to nearest or flushes small numbers to zero. With several parts, this
///           holds for the process whose `exchange` has completed the list.
[[nodiscard]] Verification verify(std::istream& file, const Options& options = {});

/// Returns the result as one text for a person: outcome, claim, counts.
[[nodiscard]] std::string describe(const Verification& verification);

[[nodiscard]] const char* name(Outcome outcome) noexcept;

}  // namespace regulus::verifier
