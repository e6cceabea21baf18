// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/command/page_run.hpp"

#include <fmt/format.h>

#include "codegen/answer/ask.hpp"
#include "codegen/certificate/certificate_question.hpp"
#include "codegen/command/answer.hpp"
#include "codegen/command/run_question.hpp"
#include "codegen/command/shared_options.hpp"
#include "codegen/model/read_file.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/scratch_folder.hpp"

namespace regulus::inline command {
namespace {

using Json = nlohmann::ordered_json;

/// A page has the proof itself.
Json without_files(Json report) {
  for (const char* key : {"certificate", "certificate_obstacle", "certificate_note"})
    report.erase(key);
  return report;
}

const char* verdict_words(const std::string& verdict) {
  return verdict == "no-singularity" ? name(Verdict::kNoSingularity)
         : verdict == "singularity"  ? name(Verdict::kSingularity)
                                     : name(Verdict::kPossibleProblem);
}

}  // namespace

PageRun::PageRun(const ReportCommand& command, const std::string& typed)
    : command_(command), typed_(typed), model_(command.model) {}

void PageRun::run() {
  data_.command = typed_;
  take_earlier();
  interrupt_.emplace();
  if (data_.report.is_null()) check();
  if (command_.paves) pave();
  for (const std::string& quantity : command_.bounds) bound(quantity);
  for (const std::string& margin : command_.margins) bracket(margin);
}

PageTexts PageRun::texts() const {
  const nlohmann::ordered_json& report = data_.report;
  const std::string verdict = report.value("verdict", "");
  return {.title = fmt::format("{}, {}: {}", report.value("model", ""), report.value("motion", ""),
                               verdict_words(verdict)),
          .verdict = verdict_words(verdict),
          .claim = report.value("claim", ""),
          .report = text_,
          .data = json_text(data_)};
}

nlohmann::ordered_json PageRun::json_report(const std::string& page) const {
  nlohmann::ordered_json report = data_.report;
  report["page"] = page;
  return report;
}

int PageRun::end() {
  if (check_) return end_answer(*check_, command_.output, interrupted());
  const std::string verdict = data_.report.value("verdict", "");
  return verdict == "no-singularity" ? kNoSingularity
         : verdict == "singularity"  ? kSingularity
                                     : kPossibleProblem;
}

Services PageRun::services() {
  Services services;
  services.dashes = "--";
  services.shows_progress = !command_.output.quiet;
  services.interrupt = &interrupted();
  services.on_search = [this] { interrupt_->begin_search(); };
  return services;
}

SearchOptions PageRun::search_of_bracket() const {
  SearchOptions search = command_.search;
  if (!search.time_limit) search.time_limit = kMarginSeconds;
  return search;
}

void PageRun::check() {
  data_.model_text = model_text(model_);
  const Request request = read_request(data_.model_text, model_);
  const std::set<std::string> uncertain = uncertain_names(request);
  set_question(data_, request, uncertain, model_);
  const ScratchFolder scratch;
  Services services = this->services();
  services.certificate = scratch.path() / "certificate";
  check_ = ask(AskCheck{model_, command_.search}, services);
  take_proof(check_->proof);
  text_ = check_->text();
  data_.report = without_files(check_->json());
  if (request.motion.trajectory && !data_.report["segment"].is_null())
    set_deciding_segment(data_, request, uncertain);
  if (!command_.output.quiet) print_report(text_);
}

void PageRun::take_proof(const ProofStatus& proof) {
  data_.certificate_note = proof.obstacle();
  if (!proof.is_written()) return;
  data_.certificate = read_start(proof.path(), kLongestProof + 1, Readable::kFile);
  if (data_.certificate.size() <= kLongestProof) return;
  data_.certificate.clear();
  data_.certificate_note =
      "its proof is longer than a page holds; `regulus check --certificate` writes it to a file";
}

void PageRun::pave() {
  std::string tree;
  Services services = this->services();
  services.tree = &tree;
  const auto paving = ask(AskPaving{model_, command_.search, command_.resolution}, services);
  if (tree.size() > kLongestProof)
    throw UsageError("the paving has more boxes than a page holds; use a coarser --resolution");
  data_.paving = {{"summary", without_files(paving->json())}};
  if (paving->stretches.empty()) {
    data_.paving["header"] = paving->header();
    data_.paving["tree"] = tree;
    return;
  }
  Json stretches = Json::array();
  for (const StretchOfWay& stretch : paving->stretches)
    stretches.push_back(Json::parse(stretch.line));
  data_.paving["stretches"] = std::move(stretches);
}

void PageRun::bound(const std::string& quantity) {
  const AskBound asked{model_,
                       search_of_bracket(),
                       {.quantity = quantity, .load = command_.load, .twist = command_.twist},
                       "",
                       command_.gap};
  data_.bounds.push_back(ask(asked, services())->json());
}

void PageRun::bracket(const std::string& margin) {
  AskMargin asked{model_, search_of_bracket(), {}, {}, "", command_.gap};
  asked.model.tolerances.push_back(margin);
  data_.margins.push_back(ask(asked, services())->json());
}

}  // namespace regulus::command
