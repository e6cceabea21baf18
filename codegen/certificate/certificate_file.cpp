// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/certificate/certificate_file.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>

#include "codegen/certificate/certificate_question.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/certificate/format.hpp"
#include "runtime/certificate/verifier/verify.hpp"

namespace regulus::inline certificate {

namespace {

/// Returns why the verifier may not finish. It proves each leaf itself, in one box at least.
std::string doubt_of(const Statistics& statistics) {
  const auto filtered = statistics.leaves[static_cast<std::size_t>(Rule::kFilter)];
  const auto leaves =
      std::accumulate(statistics.leaves.begin(), statistics.leaves.end(), std::uint64_t{0});
  const std::uint64_t most_boxes = verifier::Options().max_boxes;
  if (filtered > 0)
    return std::to_string(filtered) + " boxes rest on a filter, which the verifier does not use";
  if (leaves > most_boxes)
    return "it has " + std::to_string(leaves) + " leaves, but the verifier evaluates at most " +
           std::to_string(most_boxes) + " boxes; use regulus verify --max-boxes to allow more";
  if (statistics.max_frontier > format::kMostOpen)
    return "more boxes are open at one time than the verifier allows, " +
           std::to_string(format::kMostOpen);
  return "";
}

}  // namespace

CertificateFile::CertificateFile(const std::string& path, const PreparedSearch& preparation,
                                 const std::optional<CertificateWriter::Partial>& partial,
                                 std::uint64_t shard_size) {
  if (path.empty()) return;
  CertifiedQuestion question = certified_question(preparation);
  obstacle_ = certificate_obstacle(question);
  if (!obstacle_.empty()) return;
  doubt_safe_ = certificate_doubt(question, false);
  doubt_singular_ = certificate_doubt(question, true);
  try {
    if (partial) {
      lock_.emplace(path);
      writer_.emplace(path, std::move(question), *partial);
    } else {
      writer_.emplace(path, std::move(question));
    }
    writer_->set_shard_size(shard_size);
  } catch (const std::runtime_error& error) {
    throw FileError(error.what());
  }
}

void CertificateFile::finish(const Result& result) {
  if (!writer_) return;
  const bool singular = result.verdict == Verdict::kSingularity;
  note_ = singular ? doubt_singular_ : doubt_safe_;
  if (note_.empty() && !singular) note_ = doubt_of(result.statistics);
  try {
    written_ = writer_->finish(result);
  } catch (const std::runtime_error& error) {
    throw FileError(error.what());
  }
  if (!written_) obstacle_ = "POSSIBLE PROBLEM claims nothing that could be proved";
  std::error_code ignored;
  if (written_ && std::filesystem::file_size(writer_->path(), ignored) > format::kMaxBytes)
    note_ = "it is larger than the " + std::to_string(format::kMaxBytes) +
            " bytes that the verifier reads";
}

std::string CertificateFile::line() const {
  if (!obstacle_.empty()) return "certificate none: " + obstacle_ + '\n';
  if (!written_) return "";
  return "certificate " + writer_->path() + '\n' +
         (note_.empty() ? "" : "           " + note_ + '\n');
}

void CertificateFile::add_to(nlohmann::ordered_json& report) const {
  if (!writer_ && obstacle_.empty()) return;
  report["certificate"] = nullptr;
  if (written_) report["certificate"] = writer_->path();
  if (!obstacle_.empty()) report["certificate_obstacle"] = obstacle_;
  if (written_ && !note_.empty()) report["certificate_note"] = note_;
}

}  // namespace regulus::certificate
