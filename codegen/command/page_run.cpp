// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/command/page_run.hpp"

#include <fmt/format.h>

#include <iostream>

#include "codegen/analysis/least_singular.hpp"
#include "codegen/bound/bound_report.hpp"
#include "codegen/bound/bound_run.hpp"
#include "codegen/certificate/certificate_file.hpp"
#include "codegen/certificate/certificate_question.hpp"
#include "codegen/certificate/piece_question.hpp"
#include "codegen/command/end_command.hpp"
#include "codegen/command/shared_options.hpp"
#include "codegen/engine/search_run.hpp"
#include "codegen/engine/settings.hpp"
#include "codegen/margin/margin_report.hpp"
#include "codegen/margin/prepared_margin.hpp"
#include "codegen/margin/variety_attempts.hpp"
#include "codegen/model/read_file.hpp"
#include "codegen/page/paving_tree.hpp"
#include "codegen/report/paving_options.hpp"
#include "codegen/report/paving_report.hpp"
#include "codegen/report/progress.hpp"
#include "codegen/report/report.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/scratch_folder.hpp"
#include "codegen/support/stopwatch.hpp"
#include "codegen/trajectory/trajectory_certificate.hpp"
#include "codegen/trajectory/trajectory_margin.hpp"
#include "codegen/trajectory/trajectory_paving.hpp"
#include "codegen/trajectory/trajectory_report.hpp"
#include "runtime/problem/observers.hpp"
#include "runtime/search/paving.hpp"

namespace regulus::inline command {
namespace {

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

ExitCode PageRun::end() {
  if (prepared_) return end_command(*prepared_, command_.output, result_, interrupted());
  const std::string verdict = data_.report.value("verdict", "");
  return verdict == "no-singularity" ? kNoSingularity
         : verdict == "singularity"  ? kSingularity
                                     : kPossibleProblem;
}

FormingWatch PageRun::watch() const { return forming_watch(command_.output, &interrupted()); }

SearchOptions PageRun::search_of_bracket() const {
  SearchOptions search = command_.search;
  if (!search.time_limit) search.time_limit = kMarginSeconds;
  return search;
}

void PageRun::check() {
  Stopwatch stopwatch;
  data_.model_text = model_text(model_);
  Request request = read_request(data_.model_text, model_);
  if (request.motion.trajectory) return check_way(std::move(request), stopwatch.lap());
  PreparedSearch& p = prepared_.emplace(prepare(model_, command_.search, watch()));
  interrupt_->begin_search();
  set_question(data_, p.stages->request(), uncertain_names(p.labels), model_);
  search(p);
  if (!command_.output.quiet) std::cerr << text_;
}

void PageRun::search(PreparedSearch& p) {
  const ScratchFolder scratch;
  const std::string file = scratch.path() / "certificate";
  CertificateFile certificate(file, p);
  SearchDisplay display(command_.output);
  std::vector<Observer*> watching;
  for (Observer* observer : {certificate.observer(), display.observer()})
    if (observer != nullptr) watching.push_back(observer);
  Observers observers(std::move(watching));
  result_ =
      run_search(p, command_.search, settings_of(p, command_.search, &interrupted()), &observers);
  certificate.finish(result_);
  const auto nearest = nearest_singular(p, result_);
  text_ = text_report(p, command_.search, result_, nearest);
  data_.report = regulus::json_report(p, command_.search, result_, nearest);
  take_proof(certificate.status());
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

void PageRun::check_way(Request request, double model_seconds) {
  interrupt_->begin_search();
  const TrajectoryCheck found =
      check_trajectory(std::move(request), model_seconds, command_.search, true, &interrupted());
  const std::set<std::string> uncertain = uncertain_names(found.hull.labels);
  set_question(data_, found.request, uncertain, model_);
  const ScratchFolder scratch;
  const std::string file = scratch.path() / "certificate";
  take_proof(certify_trajectory(file, found));
  text_ = format_trajectory(found, command_.search);
  data_.report = json_trajectory(found, command_.search);
  if (found.deciding && found.deciding->preparation)
    data_.way["deciding_question"] =
        certified_question(piece_request(found.request, found.deciding->index), uncertain).text;
  if (!command_.output.quiet) std::cerr << text_;
}

void PageRun::pave() {
  ModelOptions model = model_;
  model.separates_reach = true;
  Request request = read_request(model);
  if (request.motion.trajectory) return pave_way(std::move(request));
  PreparedSearch p = prepare(model, command_.search, watch());
  const PavingOptions options = resolve_paving(command_.resolution, command_.search, p);
  const Problem problem = p.problem();
  Volumes volumes(problem, p.labels.reach);
  PavingTree tree(problem, p.labels.reach);
  Observers observers({&volumes, &tree});
  Settings settings = settings_of(p, command_.search, &interrupted());
  require_paving(options, settings);
  const Result paved = run_search(p, command_.search, settings, &observers);
  data_.paving = {{"header", json_paving_header(p, options)},
                  {"summary", json_paving_summary(p, command_.search, options, volumes, paved)},
                  {"tree", tree.text()}};
  if (data_.paving["tree"].get_ref<const std::string&>().size() > kLongestProof)
    throw UsageError("the paving has more boxes than a page holds; use a coarser --resolution");
}

void PageRun::pave_way(Request request) {
  const double resolution =
      command_.resolution.empty() ? kPathResolution : read_resolution(command_.resolution);
  const PathPaving paving =
      pave_trajectory(std::move(request), 0, command_.search, resolution, &interrupted());
  nlohmann::ordered_json stretches = nlohmann::ordered_json::array();
  for (const PathStretch& stretch : paving.stretches)
    stretches.push_back(json_stretch(paving, stretch));
  data_.paving = {{"summary", json_path_paving(paving, command_.search)},
                  {"stretches", std::move(stretches)}};
}

void PageRun::bound(const std::string& quantity) {
  ModelOptions model = model_;
  const QuantityOptions options{
      .quantity = quantity, .load = command_.load, .twist = command_.twist};
  refuse_threshold(model);
  if (!kind_of(quantity)) model.asked = quantity;
  BoundSettings settings;
  settings.gap = read_gap(command_.gap);
  settings.search = search_of_bracket();
  settings.output = command_.output;
  settings.interrupt = &interrupted();
  const Request request = read_request(model);
  const Bound found = bound_quantity(request, quantity_of(request.model, options), settings,
                                     [](const ComponentBound&) {});
  data_.bounds.push_back(json_bound(request, found, settings));
}

void PageRun::bracket(const std::string& margin) {
  ModelOptions model = model_;
  model.tolerances.push_back(margin);
  const MarginQuestion question = take_question(model, {});
  Request request = read_request(model);
  if (request.motion.trajectory) return bracket_way(question, std::move(request));
  PreparedMargin prepared(question, std::move(request), 0, compiled_first(search_of_bracket()),
                          watch());
  prepared.settings.interrupt = &interrupted();
  VarietyAttempts attempts(prepared, question, command_.output);
  const Margin found =
      close_bracket(attempts, question,
                    {.limits = limits_of(prepared.settings, read_gap(command_.gap)),
                     .interrupt = &interrupted()});
  data_.margins.push_back(json_margin(prepared.prepared, prepared.search,
                                      prepared.request.nominal(), question, found,
                                      read_gap(command_.gap)));
}

void PageRun::bracket_way(const MarginQuestion& question, Request request) {
  const double gap = read_gap(command_.gap);
  const MarginRequest growing(std::move(request), question);
  const TrajectoryMargin found = margin_of_trajectory(growing, question, search_of_bracket(), gap,
                                                      {.interrupt = &interrupted()});
  data_.margins.push_back(json_trajectory_margin(found, question, search_of_bracket(), gap));
}

}  // namespace regulus::command
