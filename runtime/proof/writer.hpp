// SPDX-License-Identifier: Apache-2.0
// What a certificate about regularity says (FORMAT.md), written while the search runs.
#pragma once

#include <string>

#include "runtime/proof/proof_file.hpp"

namespace regulus {

/// Returns a certificate up to its proof. `question`: lines from `model` on.
[[nodiscard]] std::string head_text(const std::string& verdict, const std::string& claim,
                                    const std::string& question);

/// The texts of a certificate about the question.
struct CertifiedQuestion {
  std::string text;            ///< FORMAT.md, "The question": lines from `model` to `constraint`
  std::string no_singularity;  ///< the claim, for either verdict
  std::string singularity;
  std::string paving{};  ///< of a closure

  /// Returns a certificate up to its proof.
  [[nodiscard]] std::string head(bool singular) const;
};

/// Returns the word of FORMAT.md for a rule. For a rule without one, no certificate is valid.
[[nodiscard]] const char* certificate_word(Rule rule) noexcept;

/// Returns a coordinate of a point: a number, or the ends of a range without one.
[[nodiscard]] std::string coordinate_text(const Interval& x);

/// Returns the lines of a proof of SINGULARITY.
///
/// Requires  result.witness.
[[nodiscard]] std::string witness_lines(const Result& result);

/// Writes splits and leaves as they come; finish() puts the file in its place.
class CertificateWriter final : public Observer {
 public:
  /// Throws as ProofFile.
  CertificateWriter(std::string path, CertifiedQuestion question);

  void on_start(const Problem& problem, const Settings& settings) noexcept override;
  void on_split(const OpenBox& box, const Split& split) noexcept override;
  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override;

  /// The proof of the result waits for file().put_in_place(). Throws as ProofFile::complete().
  ///
  /// Ensures   false for POSSIBLE PROBLEM, which claims nothing: no file is written.
  [[nodiscard]] bool complete(const Result& result);
  /// Also puts it in its place.
  [[nodiscard]] bool finish(const Result& result);

  [[nodiscard]] ProofFile& file() noexcept { return file_; }
  [[nodiscard]] const std::string& path() const noexcept { return file_.path(); }

 private:
  ProofFile file_;
  const CertifiedQuestion question_;
  const std::string safe_head_;  ///< made before the search, which has no memory to spare
};

}  // namespace regulus
