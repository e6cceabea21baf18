// SPDX-License-Identifier: GPL-3.0-or-later
// The findings of earlier runs in a page.
#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "codegen/certificate/certificate_question.hpp"
#include "codegen/command/page_run.hpp"
#include "codegen/engine/settings.hpp"
#include "codegen/formulation/variety.hpp"
#include "codegen/model/read_file.hpp"
#include "codegen/report/question_report.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::inline command {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const std::string& path, const std::string& problem,
                         const std::string& remedy) {
  throw InputError::statement(path, 0, problem, remedy);
}

/// A report of check comes first: it has the question whole, and more about it than a certificate.
int rank(const EarlierRun& run) {
  return run.kind == EarlierKind::kCheck ? 0 : run.kind == EarlierKind::kCertificate ? 1 : 2;
}

std::string json_verdict(const CertificateHead& head) {
  return head.value("verdict") == "NO SINGULARITY" ? "no-singularity" : "singularity";
}

CertificateHead head_of(const std::string& path) {
  std::istringstream text(read_start(path, CertificateHead::kLongestHead, Readable::kFile));
  return CertificateHead(text);
}

/// Returns the lines of a question that options change, without quantities of one value.
std::set<std::string> changeable_lines(const std::vector<std::string>& lines, bool has_poses) {
  std::set<std::string> result;
  for (const std::string& line : lines) {
    const bool is_wanted = line.starts_with("alpha ") || line.starts_with("parameter ") ||
                           line.starts_with("uncertain ") || line.starts_with("pose ");
    const bool is_of_poses = line.starts_with("parameter ") || line.starts_with("pose ");
    if (is_wanted && !line.ends_with(" +- 0") && (has_poses || !is_of_poses)) result.insert(line);
  }
  return result;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The lines of a report for people that an earlier run has.
std::string text_of(const Json& report) {
  std::string text;
  for (const char* key : {"model", "motion", "reason", "claim"})
    text += fmt::format("{:<10} {}\n", key, report.value(key, ""));
  return text + fmt::format("boxes      {} evaluated\n", report["boxes"].dump());
}

}  // namespace

void PageRun::take_earlier() {
  if (command_.from.empty()) return;
  std::vector<EarlierRun> runs;
  for (const std::string& path : command_.from) runs.push_back(read_earlier_run(path));
  std::ranges::stable_sort(runs, {}, rank);
  for (const EarlierKind kind :
       {EarlierKind::kCertificate, EarlierKind::kCheck, EarlierKind::kPaving})
    if (std::ranges::count(runs, kind, &EarlierRun::kind) > 1)
      throw UsageError(fmt::format("--from: a page has one {}; leave out the others", name(kind)));
  adopt_question(runs.front(), model_);
  data_.model_text = model_text(model_);
  request_ = read_request(data_.model_text, model_);
  set_question(data_, *request_, uncertain_names(*request_), model_);
  for (const EarlierRun& run : runs)
    run.kind == EarlierKind::kCertificate ? take_certificate(run) : take_report(run);
}

void PageRun::take_certificate(const EarlierRun& run) {
  // The page states the values that options have set.
  VerificationRequest request{run.path, model_.path, model_.waypoints, true, {}};
  request.options.threads = settings_from(command_.search).threads;
  request.options.time_limit = command_.search.time_limit;
  const Verified verified = verify_file(request);
  const verifier::Verification& v = verified.verification;
  if (v.outcome != verifier::Outcome::kVerified)
    refuse(run.path, std::string("this certificate is not verified: ") + v.reason,
           v.outcome == verifier::Outcome::kRejected ? "make it again with check --certificate"
                                                     : "try `regulus verify` with other limits");
  const CertificateHead head = head_of(run.path);
  take_question_of(run, head);
  if (data_.report.is_null()) begin_from_certificate(v, head);
  if (data_.report["verdict"] != json_verdict(head))
    refuse(run.path, "the verdict of this certificate is not that of the report of check",
           "give files of the same run");
  ProofStatus proof(run.path);
  proof.set_written();
  take_proof(proof);
  if (v.shards > 0) {
    data_.certificate.clear();
    data_.certificate_note = "its proof is in several files; `regulus verify` reads them";
  }
  const std::string count =
      v.leaves > 0 ? fmt::format(": {} leaves, {} boxes", v.leaves, v.boxes) : std::string();
  add_source(data_, run, "verified when this page was made" + count);
}

/// The first lines of a certificate, the verdict and the claim, are no part of its question.
void PageRun::take_question_of(const EarlierRun& run, const CertificateHead& head) {
  constexpr std::ptrdiff_t kFirstOfQuestion = 3;
  if (!head.value("load").empty())
    refuse(run.path,
           "this certificate is about forces that hold a load, which the page does not show",
           "give one of check without --load");
  // In the shell, the model may have changed in memory since its file was read.
  if (head.value("sha256") != request_->model.sha256)
    refuse(run.path, "this certificate is about another text of the model: the SHA-256 differs",
           "save the model, and make the certificate again");
  const std::vector<std::string> lines(head.lines().begin() + kFirstOfQuestion, head.lines().end());
  const bool is_piece = !data_.way.is_null() && head.value("piecewise").empty();
  if (changeable_lines(lines, !is_piece) != changeable_lines(lines_of(data_.question), !is_piece))
    refuse(run.path, "this certificate has other ranges, tolerances or errors than the page",
           "leave out --range, --tolerance, --alpha and --tube, and files of other questions");
  const std::string question = fmt::format("{}\n", fmt::join(lines, "\n"));
  if (is_piece)
    data_.way["deciding_question"] = question;
  else
    data_.question = question;
}

void PageRun::begin_from_certificate(const verifier::Verification& v, const CertificateHead& head) {
  const Request& request = *request_;
  data_.report = {{"verdict", json_verdict(head)},
                  {"claim", v.claim},
                  {"reason", "the certificate was verified"},
                  {"model", request.model.name},
                  {"model_file", request.model.path},
                  {"model_sha256", request.model.sha256},
                  {"motion", request.motion.name},
                  {"where", name(request.motion.where)},
                  {"matrix", name(request.model.matrix_kind)},
                  {"alpha", mid(enclose_constant(request.motion.alpha, "alpha"))},
                  {"method", "verification"},
                  {"boxes", v.boxes},
                  {"witness", nullptr},
                  {"blocking_box", nullptr},
                  {"question", json_question(request, command_.search)}};
  text_ = text_of(data_.report);
}

void PageRun::take_report(const EarlierRun& run) {
  require_same_question(run, *request_);
  const char* note = "quoted: not run again";
  switch (run.kind) {
    case EarlierKind::kCertificate:
      return;
    case EarlierKind::kCheck:
      data_.report = run.report;
      text_ = text_of(data_.report);
      note = "quoted: the verdict was not searched for again";
      break;
    case EarlierKind::kPaving:
      take_paving(run);
      break;
    case EarlierKind::kBound:
      data_.bounds.push_back(run.report);
      break;
    case EarlierKind::kMargin:
      data_.margins.push_back(run.report);
      break;
  }
  add_source(data_, run, note);
}

void PageRun::take_paving(const EarlierRun& run) {
  if (run.tree.size() > kLongestProof)
    refuse(run.path, "these are more boxes than a page holds", "use a coarser --resolution");
  data_.paving = {{"header", run.header}, {"summary", run.report}};
  data_.paving["tree"] = run.tree.empty() ? Json() : Json(run.tree);
  data_.paving["stretches"] = run.stretches;
}

}  // namespace regulus::command
