// SPDX-License-Identifier: GPL-3.0-or-later
// What --checkpoint asks for.
#pragma once

#include <optional>
#include <string>

#include "codegen/engine/options.hpp"
#include "codegen/engine/pipeline.hpp"
#include "codegen/support/file_digest.hpp"
#include "runtime/certificate/writer.hpp"
#include "runtime/checkpoint/file_lock.hpp"
#include "runtime/checkpoint/writer.hpp"

namespace regulus::inline engine {

class CheckpointFile {
 public:
  /// Reads the file if there is one. `path` empty: none is wanted. Throws InputError for a file
  /// that is no checkpoint of this question, FileError when it cannot be read or made, or when
  /// another run uses it.
  CheckpointFile(const CheckpointOptions& options, const PreparedSearch& preparation,
                 const Settings& settings);

  [[nodiscard]] bool wanted() const noexcept { return !path_.empty(); }
  /// Where the search goes on; nullptr: it starts from the beginning.
  [[nodiscard]] const Checkpoint* found() const noexcept { return found_ ? &*found_ : nullptr; }
  /// How the certificate goes on; nullopt: without a checkpoint it does not. Throws InputError when
  /// one is wanted and the checkpoint found has none, or one of other bytes.
  [[nodiscard]] std::optional<CertificateWriter::Partial> partial(const std::string& certificate);

  /// Watches the search, and tells the certificate to be safe first; nullptr if none is wanted.
  [[nodiscard]] Observer* observer(CertificateWriter* certificate);

  /// After the search: keeps the file of one that may go on, removes that of another. Throws
  /// FileError when a search that may go on could not be saved.
  void finish(const Result& result, CertificateWriter* certificate);
  /// A line of the report; empty if there is nothing to say.
  [[nodiscard]] std::string line() const;

 private:
  void require_undamaged(const std::string& certificate);

  std::string path_;
  double interval_;
  std::optional<FileLock> lock_;
  CheckpointedQuestion question_;
  std::optional<Checkpoint> found_;
  std::optional<FileDigest> digest_;  ///< of the certificate so far
  std::optional<CheckpointWriter> writer_;
  bool kept_ = false;
};

}  // namespace regulus::inline engine
