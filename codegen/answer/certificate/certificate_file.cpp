// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/certificate/certificate_file.hpp"

#include <filesystem>
#include <numeric>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "runtime/proof/format.hpp"
#include "runtime/verifier/verify.hpp"

namespace regulus::detail {

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
                                 std::uint64_t shard_size)
    : status_(path) {
  if (!status_.is_wanted()) return;
  CertifiedQuestion question = certified_question(preparation);
  status_.set_obstacle(certificate_obstacle(question));
  if (!status_.obstacle().empty()) return;
  doubt_safe_ = certificate_doubt(question, false);
  doubt_singular_ = certificate_doubt(question, true);
  with_file_errors([&] { writer_.emplace(path, std::move(question)); });
  writer_->file().set_shard_size(shard_size);
}

void CertificateFile::finish(const Result& result) {
  if (!writer_) return;
  bool claims = false;
  status_.attempt([&] { claims = with_file_errors([&] { return writer_->finish(result); }); });
  if (status_.is_lost()) return;
  if (!claims) return status_.set_obstacle(kNothingClaimed);
  const bool singular = result.verdict == Verdict::kSingularity;
  std::string note = singular ? doubt_singular_ : doubt_safe_;
  if (note.empty() && !singular) note = doubt_of(result.statistics);
  std::error_code ignored;
  if (std::filesystem::file_size(writer_->path(), ignored) > format::kMaxBytes)
    note = "it is larger than the " + std::to_string(format::kMaxBytes) +
           " bytes that the verifier reads";
  status_.set_written(std::move(note));
}

}  // namespace regulus::detail
