// SPDX-License-Identifier: GPL-3.0-or-later
// The option --certificate.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "codegen/engine/pipeline.hpp"
#include "runtime/certificate/writer.hpp"
#include "runtime/files/file_lock.hpp"

namespace regulus::inline certificate {

class CertificateFile {
 public:
  /// An empty `path` means no certificate. Throws FileError, before the search, if the file cannot
  /// be made. `partial`: for a search that may be continued, or that continues an earlier one.
  /// `shard_size`: as CertificateWriter::set_shard_size.
  CertificateFile(const std::string& path, const PreparedSearch& preparation,
                  const std::optional<CertificateWriter::Partial>& partial = std::nullopt,
                  std::uint64_t shard_size = 0);

  /// Returns the observer of the search; nullptr if no certificate is wanted, or none can be made.
  [[nodiscard]] Observer* observer() noexcept { return writer_ ? &*writer_ : nullptr; }

  /// Moves the file to its final name if the verdict claims something. Throws FileError.
  void finish(const Result& result);

  /// Returns nullptr if no certificate is wanted.
  [[nodiscard]] CertificateWriter* writer() noexcept { return writer_ ? &*writer_ : nullptr; }
  [[nodiscard]] bool written() const noexcept { return written_; }
  /// Returns lines of the report; empty if no certificate was wanted.
  [[nodiscard]] std::string line() const;
  /// Adds the key `certificate` to a JSON report: the file, or null if none could be written. Also
  /// adds `certificate_obstacle`, the reason why there is none, and `certificate_note`, the reason
  /// why the verifier may not finish.
  void add_to(nlohmann::ordered_json& report) const;

 private:
  std::optional<FileLock> lock_;  ///< of a file that several runs write
  std::optional<CertificateWriter> writer_;
  bool written_ = false;
  std::string obstacle_;  ///< why there is none
  /// The reasons why the verifier may not finish: for each verdict, and for the one reached.
  std::string doubt_safe_, doubt_singular_, note_;
};

}  // namespace regulus::certificate
