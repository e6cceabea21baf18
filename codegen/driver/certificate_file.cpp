// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/certificate_file.hpp"

#include <nlohmann/json.hpp>

#include "regulus/codegen/driver/certificate_question.hpp"
#include "regulus/codegen/model/errors.hpp"

namespace regulus::codegen {

CertificateFile::CertificateFile(const std::string& path, const Preparation& preparation,
                                 const std::optional<CertificateWriter::Partial>& partial) {
  if (path.empty()) return;
  CertifiedQuestion question = certified_question(preparation);
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
  try {
    written_ = writer_->finish(result);
  } catch (const std::runtime_error& error) {
    throw FileError(error.what());
  }
}

std::string CertificateFile::line() const {
  if (!writer_) return "";
  return "certificate " +
         (written_ ? writer_->path()
                   : "none: POSSIBLE PROBLEM claims nothing that could be proved") +
         '\n';
}

void CertificateFile::add_to(nlohmann::ordered_json& report) const {
  if (!writer_) return;
  report["certificate"] = nullptr;
  if (written_) report["certificate"] = writer_->path();
}

}  // namespace regulus::codegen
