// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/margin/margin_certificates.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

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
                                       const ReportLabels& subject)
    : path_(std::move(path)), request_(request), uncertain_(uncertain_names(subject)) {
  if (!wanted()) return;
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
  with_file([&] { search_.emplace(path_ + kSafe, std::move(question)); });
  return &*search_;
}

void MarginCertificates::finish(const MarginValue& value, const Result& result) {
  if (!wanted()) return;
  if (obstacle_.empty())
    obstacle_ = certificate_obstacle(question_at(value), result.verdict == Verdict::kSingularity);
  if (!obstacle_.empty()) return;
  if (result.verdict == Verdict::kNoSingularity) {
    with_file([&] { static_cast<void>(search_->finish(result)); });
    safe_ = {path_ + kSafe, value.text};
  }
  if (result.verdict == Verdict::kSingularity) {
    with_file([&] {
      CertificateWriter writer(path_ + kSingular, question_at(value));
      static_cast<void>(writer.finish(result));
    });
    singular_ = {path_ + kSingular, value.text};
  }
  search_.reset();
}

std::string MarginCertificates::lines() const {
  if (!wanted()) return "";
  if (!obstacle_.empty()) return "certificate none: " + obstacle_ + '\n';
  const auto proved = [](const Proved& end, const char* words) {
    return fmt::format("{}: {} {}\n", end.file, words, end.value);
  };
  return "certificate " +
         (safe_ ? proved(*safe_, "safe at") : "none for the safe end: no safe value was found\n") +
         "           " +
         (singular_ ? proved(*singular_, "singular at")
                    : "none for the singular end: no singularity was found\n");
}

void MarginCertificates::add_to(nlohmann::ordered_json& report) const {
  if (!wanted()) return;
  const auto file = [](const std::optional<Proved>& end) {
    return end ? nlohmann::ordered_json(end->file) : nlohmann::ordered_json(nullptr);
  };
  report["certificates"] = {{"safe", file(safe_)}, {"singular", file(singular_)}};
}

}  // namespace regulus::bracketing
