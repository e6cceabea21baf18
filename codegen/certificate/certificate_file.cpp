// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/certificate/certificate_file.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "codegen/certificate/certificate_question.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/certificate/format.hpp"

namespace regulus::inline certificate {

namespace {

/// The verifier proves each leaf by its own means; where these may not be enough.
std::string unfollowed_rules(const Result& result) {
  const auto leaves = [&result](Rule rule) {
    return result.statistics.leaves[static_cast<std::size_t>(rule)];
  };
  if (result.verdict != Verdict::kNoSingularity || leaves(Rule::kFilter) == 0) return "";
  return std::to_string(leaves(Rule::kFilter)) +
         " boxes rest on a filter of yours, which the verifier does not follow";
}

}  // namespace

CertificateFile::CertificateFile(const std::string& path, const PreparedSearch& preparation,
                                 const std::optional<CertificateWriter::Partial>& partial) {
  if (path.empty()) return;
  CertifiedQuestion question = certified_question(preparation);
  obstacle_ = certificate_obstacle(question);
  if (!obstacle_.empty()) return;
  try {
    if (partial) {
      lock_.emplace(path);
      writer_.emplace(path, std::move(question), *partial);
    } else {
      writer_.emplace(path, std::move(question));
    }
  } catch (const std::runtime_error& error) {
    throw FileError(error.what());
  }
}

void CertificateFile::finish(const Result& result) {
  if (!writer_) return;
  note_ = unfollowed_rules(result);
  try {
    written_ = writer_->finish(result);
  } catch (const std::runtime_error& error) {
    throw FileError(error.what());
  }
  std::error_code ignored;
  if (written_ && std::filesystem::file_size(writer_->path(), ignored) > format::kMaxBytes)
    note_ = "it is larger than the " + std::to_string(format::kMaxBytes) +
            " bytes that the verifier reads";
}

std::string CertificateFile::line() const {
  if (!obstacle_.empty()) return "certificate none: " + obstacle_ + '\n';
  if (!writer_) return "";
  if (!written_) return "certificate none: POSSIBLE PROBLEM claims nothing that could be proved\n";
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

}  // namespace regulus::inline certificate
