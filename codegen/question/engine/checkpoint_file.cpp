// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/checkpoint_file.hpp"

#include <fmt/format.h>

#include <numeric>

#include "codegen/model/file/read_file.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/files/sha256.hpp"

namespace regulus {
namespace {

std::string ends_of(const Interval& x) { return fmt::format(" {:a}:{:a}", x.lo, x.hi); }

/// Returns all inputs on which the results about boxes depend, without the way in which they were
/// computed. Filters and texts are included, because they are not checked: a run that continues must
/// name them, too.
CheckpointedQuestion question_of(const PreparedSearch& p, const Settings& settings) {
  const regulus_kernel& kernel = p.kernel->functions();
  const bool splits_uncertainty = settings.uncertainty == Uncertainty::kVariables;
  std::string text = p.labels.model_sha256 + '\n' + p.labels.motion + '\n';
  for (const Interval& x : p.variety.outer) text += ends_of(x);
  text += "\nalpha" + ends_of(p.variety.alpha);
  text += splits_uncertainty ? "\nvariables" : "\nelements";
  for (const FilterFile& filter : p.filters) text += "\nfilter " + filter.sha256();
  if (p.text) text += "\nkernel " + p.text->sha256;
  CheckpointedQuestion question;
  question.identity = sha256(text);
  question.splittable = splits_uncertainty ? kernel.variables : kernel.motion_variables;
  question.ranges = p.variety.outer;
  return question;
}

constexpr std::uint64_t kLargestCheckpoint = std::uint64_t{4} << 30;

/// Returns nullopt if there is no such file.
std::optional<std::string> read_text(const std::string& path) {
  try {
    return read_file_if_any(path, kLargestCheckpoint, Readable::kFile);
  } catch (const FileError& error) {
    throw FileError(std::string("the checkpoint ") + error.what());
  }
}

std::uint64_t leaves_of(const Checkpoint& checkpoint) {
  const auto& leaves = checkpoint.state.statistics.leaves;
  return std::accumulate(leaves.begin(), leaves.end(), std::uint64_t{0});
}

}  // namespace

CheckpointFile::CheckpointFile(const CheckpointOptions& options, const PreparedSearch& preparation,
                               const Settings& settings)
    : path_(options.path), interval_(options.interval) {
  if (!wanted()) return;
  try {
    lock_.emplace(path_);
  } catch (const std::runtime_error& error) {
    throw FileError(std::string("the checkpoint ") + error.what());
  }
  question_ = question_of(preparation, settings);
  const std::optional<std::string> text = read_text(path_);
  if (!text) return;
  try {
    found_ = read_checkpoint(*text, question_);
  } catch (const CheckpointError& error) {
    throw InputError::statement(
        path_, 0, std::string("the search cannot continue from this file: ") + error.what(),
        "name another file, or delete this one to start again");
  }
}

std::optional<ProofFile::Partial> CheckpointFile::partial(const std::string& certificate) {
  if (!wanted()) return std::nullopt;
  if (!found_ || certificate.empty()) return ProofFile::Partial{};
  if (!found_->certificate)
    throw InputError::statement(path_, 0, "the checkpoint is of a search without --certificate",
                                "leave out --certificate, or delete the checkpoint to start again");
  require_undamaged(certificate);
  return ProofFile::Partial{found_->certificate->length, leaves_of(*found_)};
}

/// The writer reports a file that is missing or too short.
void CheckpointFile::require_undamaged(const std::string& certificate) {
  const CertificateSoFar& expected = *found_->certificate;
  const std::string file = ProofFile::partial_file(certificate);
  digest_.emplace(file);
  const auto found = digest_->of_first(expected.length);
  if (!found || *found == expected.sha256) return;
  throw InputError::statement(
      file, 0, "the unfinished proof has changed since the checkpoint " + path_ + " was saved",
      "delete both files to start again");
}

Observer* CheckpointFile::observer(ProofFile* certificate) {
  if (!wanted()) return nullptr;
  CheckpointWriter::Certificate sync;
  if (certificate != nullptr) {
    if (!digest_) digest_.emplace(ProofFile::partial_file(certificate->path()));
    sync = [this, certificate]() -> std::optional<CertificateSoFar> {
      const auto length = certificate->sync();
      const auto sha256 = length ? digest_->of_first(*length) : std::nullopt;
      if (!sha256) return std::nullopt;
      return CertificateSoFar{*length, *sha256};
    };
  }
  const std::chrono::duration<double> interval(interval_);
  writer_.emplace(path_, question_,
                  std::chrono::duration_cast<CheckpointWriter::Clock::duration>(interval), sync);
  try {
    writer_->require_writable();
  } catch (const std::runtime_error& error) {
    throw FileError(error.what());
  }
  return &*writer_;
}

void CheckpointFile::finish(const Result& result, ProofFile* certificate) {
  if (!writer_) return;
  kept_ = result.verdict == Verdict::kPossibleProblem && result.stopped_by.has_value();
  if (kept_ && !writer_->failure().empty()) throw FileError(writer_->failure());
  if (kept_) return;
  writer_->remove();
  if (certificate != nullptr) certificate->discard();
}

std::string CheckpointFile::line() const {
  std::string text;
  if (found_)
    text = fmt::format("           continued from {} boxes\n", found_->state.statistics.boxes);
  if (kept_) text += "checkpoint " + path_ + ": repeat the command to continue from here\n";
  if (writer_ && !kept_ && !writer_->failure().empty())
    text += "checkpoint " + writer_->failure() + '\n';
  return text;
}

}  // namespace regulus
