// SPDX-License-Identifier: GPL-3.0-or-later
// The option --checkpoint.
#pragma once

#include <optional>
#include <string>

#include "codegen/question/engine/options.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/support/file_digest.hpp"
#include "runtime/checkpoint/writer.hpp"
#include "runtime/files/file_lock.hpp"
#include "runtime/proof/writer.hpp"

namespace regulus {

class CheckpointFile {
 public:
  /// Reads the file if there is one. `path` empty: no checkpoint. Throws InputError for a file that
  /// is not a checkpoint of this question, FileError if it cannot be read or created, or if another
  /// run uses it.
  CheckpointFile(const CheckpointOptions& options, const PreparedSearch& preparation,
                 const Settings& settings);

  [[nodiscard]] bool wanted() const noexcept { return !path_.empty(); }
  /// Returns the state from which the search continues; nullptr: it starts from the beginning.
  [[nodiscard]] const Checkpoint* found() const noexcept { return found_ ? &*found_ : nullptr; }
  /// Returns the state from which the certificate continues; nullopt without a checkpoint. Throws
  /// InputError if a certificate is wanted and the checkpoint has none, or one with other bytes.
  [[nodiscard]] std::optional<ProofFile::Partial> partial(const std::string& certificate);

  /// Returns the observer that saves the search, after it has made the certificate safe; nullptr
  /// without a checkpoint.
  [[nodiscard]] Observer* observer(ProofFile* certificate);

  /// Call it after the search: it keeps the file if the search may continue, and removes it
  /// otherwise. Throws FileError if a search that may continue could not be saved.
  void finish(const Result& result, ProofFile* certificate);
  /// Returns a line of the report, or an empty text.
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

}  // namespace regulus
