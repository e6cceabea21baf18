// SPDX-License-Identifier: GPL-3.0-or-later
// What --certificate asks for.
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
  /// `path` empty: none is wanted. Throws FileError when it cannot be made, before the search.
  /// `partial`: of a search that may be continued, or continues one.
  CertificateFile(const std::string& path, const PreparedSearch& preparation,
                  const std::optional<CertificateWriter::Partial>& partial = std::nullopt);

  /// Watches the search; nullptr if none is wanted, or none can be.
  [[nodiscard]] Observer* observer() noexcept { return writer_ ? &*writer_ : nullptr; }

  /// Puts the file in its place if the verdict claims something. Throws FileError.
  void finish(const Result& result);

  /// nullptr if none is wanted.
  [[nodiscard]] CertificateWriter* writer() noexcept { return writer_ ? &*writer_ : nullptr; }
  [[nodiscard]] bool written() const noexcept { return written_; }
  /// Lines of the report; empty if none was wanted.
  [[nodiscard]] std::string line() const;
  /// The key `certificate` of a JSON report: the file, null if none could be written. With
  /// `certificate_obstacle`: why there is none, and `certificate_note`: why the verifier may not
  /// finish.
  void add_to(nlohmann::ordered_json& report) const;

 private:
  std::optional<FileLock> lock_;  ///< of a file that several runs write
  std::optional<CertificateWriter> writer_;
  bool written_ = false;
  std::string obstacle_;  ///< why there can be no certificate of this question
  /// The reason why the verifier may not finish, for either verdict, and for this one.
  std::string doubt_safe_, doubt_singular_, note_;
};

}  // namespace regulus::certificate
