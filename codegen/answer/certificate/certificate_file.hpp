// SPDX-License-Identifier: GPL-3.0-or-later
// The option --certificate.
#pragma once

#include <optional>
#include <string>

#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "runtime/proof/writer.hpp"

namespace regulus::detail {

class CertificateFile {
 public:
  /// An empty `path` means no certificate. Throws FileError, before the search, if the file cannot
  /// be made. `shard_size`: as ProofFile::set_shard_size.
  CertificateFile(const std::string& path, const PreparedSearch& preparation,
                  std::uint64_t shard_size = 0);

  /// Returns the observer of the search; nullptr if no certificate is wanted, or none can be made.
  [[nodiscard]] Observer* observer() noexcept { return writer_ ? &*writer_ : nullptr; }

  /// Moves the file to its final name if the verdict claims something. If this fails, status() says so.
  void finish(const Result& result);

  /// Returns nullptr if no certificate is wanted, or none can be made.
  [[nodiscard]] ProofFile* file() noexcept { return writer_ ? &writer_->file() : nullptr; }
  [[nodiscard]] const ProofStatus& status() const noexcept { return status_; }

 private:
  std::optional<CertificateWriter> writer_;
  ProofStatus status_;
  std::string doubt_safe_, doubt_singular_;  ///< why the verifier may not finish, by verdict
};

}  // namespace regulus::detail
