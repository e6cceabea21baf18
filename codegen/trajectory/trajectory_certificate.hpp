// SPDX-License-Identifier: GPL-3.0-or-later
// The option --certificate for a motion along a trajectory.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "codegen/certificate/piece_question.hpp"
#include "codegen/support/held_files.hpp"
#include "codegen/trajectory/trajectory_run.hpp"

namespace regulus::inline trajectory {

/// The motion of a certificate and its question, if it is not that of the check.
struct CertifiedMotion {
  const Request& request;
  CertifiedAbout about;
};

class TrajectoryCertificate {
 public:
  /// An empty `path` means no certificate. Writes the proof of the verdict: of all pieces, or the
  /// singular pose on one of them. `held`: where it waits for the end of the run. Throws FileError.
  TrajectoryCertificate(std::string path, const TrajectoryCheck& check);
  TrajectoryCertificate(std::string path, const TrajectoryCheck& check,
                        const CertifiedMotion& motion, HeldFiles* held = nullptr);

  /// The same as those of CertificateFile.
  [[nodiscard]] std::string line() const;
  void add_to(nlohmann::ordered_json& report) const;
  /// Returns the reason why there is none; empty if it was written, or not wanted.
  [[nodiscard]] const std::string& obstacle() const noexcept { return obstacle_; }

 private:
  void write_safe(const TrajectoryCheck& check, const CertifiedMotion& motion);
  void write_singular(const TrajectoryCheck& check, const CertifiedMotion& motion);

  std::string path_, obstacle_;
  HeldFiles* held_ = nullptr;
  bool written_ = false;
};

/// Writes the proof of a verdict that has a witness. Returns false if it claims nothing. Throws
/// FileError.
bool certify_witness(const std::string& path, CertifiedQuestion question, const Result& result,
                     HeldFiles* held);

}  // namespace regulus::trajectory
