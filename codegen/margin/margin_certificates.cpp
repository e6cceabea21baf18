// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/margin/margin_certificates.hpp"

#include "codegen/certificate/certificate_question.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::inline bracketing {
namespace {

constexpr const char* kSafe = ".safe";
constexpr const char* kSingular = ".singular";

/// Reports a failure of a writer as a FileError.
template <class Action>
void with_file(Action action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    throw FileError(error.what());
  }
}

}  // namespace

MarginCertificates::MarginCertificates(std::string path, const MarginRequest& request,
                                       const ReportLabels& subject, HeldFiles* held)
    : path_(std::move(path)), request_(request), uncertain_(uncertain_names(subject)), held_(held) {
  if (!wanted()) return;
  // At the value 0, too, the search has a variable for each of them.
  uncertain_.merge(request_.with_control_errors());
  // Checked before the first search, which may take long.
  for (const char* ending : {kSafe, kSingular})
    with_file([&] { const CertificateWriter probe(path_ + ending, {}); });
}

std::vector<OutputFile> MarginCertificates::files(const std::string& path) {
  if (path.empty()) return {};
  return {{"--certificate", path + kSafe, true}, {"--certificate", path + kSingular, true}};
}

CertifiedQuestion MarginCertificates::question_at(const MarginValue& value) const {
  return request_.certified_at(value, uncertain_);
}

Observer* MarginCertificates::watch(const MarginValue& value) {
  if (!wanted()) return nullptr;
  CertifiedQuestion question = question_at(value);
  search_.reset();
  obstacle_ = certificate_obstacle(question);
  if (!obstacle_.empty()) return nullptr;
  with_file(
      [&] { search_ = std::make_shared<CertificateWriter>(path_ + kSafe, std::move(question)); });
  return search_.get();
}

void MarginCertificates::finish(std::shared_ptr<CertificateWriter> writer,
                                const Result& result) const {
  bool claims = false;
  with_file([&] { claims = writer->complete(result); });
  const std::string path = writer->path();
  if (claims)
    hold_or_put(held_, path,
                [writer = std::move(writer)] { with_file([&] { writer->put_in_place(); }); });
}

void MarginCertificates::finish(const MarginValue& value, const Result& result) {
  if (!wanted()) return;
  if (obstacle_.empty())
    obstacle_ = certificate_obstacle(question_at(value), result.verdict == Verdict::kSingularity);
  if (!obstacle_.empty()) return;
  if (result.verdict == Verdict::kNoSingularity) {
    finish(std::move(search_), result);
    safe_ = {path_ + kSafe, value.text};
  }
  if (result.verdict == Verdict::kSingularity) {
    std::shared_ptr<CertificateWriter> writer;
    with_file([&] {
      writer = std::make_shared<CertificateWriter>(path_ + kSingular, question_at(value));
    });
    finish(std::move(writer), result);
    singular_ = {path_ + kSingular, value.text};
  }
  search_.reset();
}

EndProofs MarginCertificates::proofs() const {
  const auto end = [this](const std::optional<Proved>& proved, const char* words,
                          const char* why_none) -> EndProof {
    if (proved) return {proved->file, std::string(words) + ' ' + proved->value};
    return {{}, obstacle_.empty() ? why_none : obstacle_};
  };
  return {wanted(), end(safe_, "safe at", "no safe value was found"),
          end(singular_, "singular at", "no singularity was found")};
}

}  // namespace regulus::bracketing
