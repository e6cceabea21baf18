// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/checkpoint_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <numeric>
#include <sstream>

#include "regulus/codegen/model/errors.hpp"
#include "regulus/codegen/model/sha256.hpp"

namespace regulus::codegen {
namespace {

std::string words_of(const Interval& x) { return fmt::format(" {:a}:{:a}", x.lo, x.hi); }

/// Everything that what is known about a box depends on; not how it was found out. Filters belong
/// to it, since nobody has checked what they vouched for: whoever goes on must name them, too.
CheckpointedQuestion question_of(const Preparation& p, const Settings& settings) {
  const regulus_kernel& kernel = p.kernel->functions();
  const bool splits_uncertainty = settings.uncertainty == Uncertainty::kVariables;
  std::string text = p.subject.model_sha256 + '\n' + p.subject.motion + '\n';
  for (const Interval& x : p.variety.outer) text += words_of(x);
  text += "\nalpha" + words_of(p.variety.alpha);
  text += splits_uncertainty ? "\nvariables" : "\nelements";
  for (const FilterFile& filter : p.filters) text += "\nfilter " + filter.sha256();
  CheckpointedQuestion question;
  question.identity = sha256(text);
  question.splittable = splits_uncertainty ? kernel.variables : kernel.motion_variables;
  question.ranges = p.variety.outer;
  return question;
}

/// nullopt: there is no such file.
std::optional<std::string> read_file(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file && errno == ENOENT) return std::nullopt;
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw FileError("the checkpoint " + path + " cannot be read: " + std::strerror(errno));
  return text.str();
}

std::uint64_t leaves_of(const Checkpoint& checkpoint) {
  const auto& leaves = checkpoint.state.statistics.leaves;
  return std::accumulate(leaves.begin(), leaves.end(), std::uint64_t{0});
}

}  // namespace

CheckpointFile::CheckpointFile(const CheckpointOptions& options, const Preparation& preparation,
                               const Settings& settings)
    : path_(options.path), interval_(options.interval) {
  if (!wanted()) return;
  try {
    lock_.emplace(path_);
  } catch (const std::runtime_error& error) {
    throw FileError(std::string("the checkpoint ") + error.what());
  }
  question_ = question_of(preparation, settings);
  const std::optional<std::string> text = read_file(path_);
  if (!text) return;
  try {
    found_ = read_checkpoint(*text, question_);
  } catch (const CheckpointError& error) {
    throw InputError(path_, 0, error.what(), "the checkpoint of this search, or no file");
  }
}

std::optional<CertificateWriter::Partial> CheckpointFile::partial(
    const std::string& certificate) const {
  if (!wanted()) return std::nullopt;
  if (!found_ || certificate.empty()) return CertificateWriter::Partial{};
  if (!found_->certificate)
    throw InputError(path_, 0, "a checkpoint of a search without --certificate",
                     "the same options as before, or no file");
  return CertificateWriter::Partial{found_->certificate, leaves_of(*found_)};
}

Observer* CheckpointFile::observer(CertificateWriter* certificate) {
  if (!wanted()) return nullptr;
  CheckpointWriter::Certificate sync;
  if (certificate != nullptr) sync = [certificate] { return certificate->sync(); };
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

void CheckpointFile::finish(const Result& result, CertificateWriter* certificate) {
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
  if (kept_) text += "checkpoint " + path_ + ": the same command goes on from here\n";
  if (writer_ && !kept_ && !writer_->failure().empty())
    text += "checkpoint " + writer_->failure() + '\n';
  return text;
}

}  // namespace regulus::codegen
