// SPDX-License-Identifier: GPL-3.0-or-later
// What is the largest or least value of a quantity? And all of them: a datasheet.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "codegen/answer/ask.hpp"
#include "codegen/answer/bracket_ends.hpp"
#include "codegen/answer/outputs.hpp"
#include "codegen/answer/refusals.hpp"
#include "codegen/question/bound/bound_question.hpp"
#include "codegen/question/bound/bound_report.hpp"
#include "codegen/question/bound/bound_run.hpp"
#include "codegen/question/bound/datasheet.hpp"
#include "codegen/question/closure/branch_bound.hpp"
#include "codegen/question/margin/prepared_margin.hpp"
#include "codegen/question/way/trajectory_report.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

BoundAnswer::Verdict verdict_of(LimitVerdict verdict) {
  switch (verdict) {
    case LimitVerdict::kWithin:
      return BoundAnswer::Verdict::kWithin;
    case LimitVerdict::kExceeded:
      return BoundAnswer::Verdict::kExceeded;
    case LimitVerdict::kUndecided:
      break;
  }
  return BoundAnswer::Verdict::kUndecided;
}

class AnswerOfBound final : public BoundAnswer {
 public:
  AnswerOfBound(BoundQuestion question, const AskBound& asked, const Services& services)
      : request_(std::move(question.request)) {
    settings_.gap = read_gap(asked.gap);
    settings_.limit = question.limit;
    settings_.search = asked.search;
    settings_.output = display_of(services);
    settings_.certificate = services.certificate;
    settings_.interrupt = services.interrupt;
    if (request_.model.closure) settings_.over_branch = bounds_over_branch();
    services.begin_search();
    if (services.on_line) services.tell(format_asked(request_, question.quantity, settings_.limit));
    run(std::move(question.quantity), services);
    describe();
  }

  [[nodiscard]] Word word() const override {
    switch (verdict) {
      case Verdict::kWithin:
        return Word::kProved;
      case Verdict::kExceeded:
        return Word::kRefuted;
      case Verdict::kUndecided:
        return Word::kOpen;
      case Verdict::kBracket:
        break;
    }
    if (std::ranges::any_of(found_.components, &ComponentBound::is_singular)) return Word::kRefuted;
    return closed ? Word::kProved : Word::kOpen;
  }
  [[nodiscard]] std::string headline() const override { return describe_bound(found_, settings_); }
  void tell(Facts& facts) const override { tell_bound(request_, found_, settings_, facts); }
  [[nodiscard]] std::string warning() const override { return checkpoint_line_; }

 private:
  void run(Quantity quantity, const Services& services) {
    HeldFiles held;
    settings_.placing = {&held, services.shard_size};
    std::optional<BracketCheckpoint> checkpoint;
    if (!services.checkpoint.path.empty())
      settings_.checkpoint = &checkpoint.emplace(
          services.checkpoint.path, checkpointed_question(request_, quantity, settings_.search));
    found_ = bound_quantity(
        request_, std::move(quantity), settings_, [&](const ComponentBound& component) {
          services.tell(format_component(component, settings_.limit.has_value()));
        });
    std::vector<EndProofs*> ends;
    for (ComponentBound& c : found_.components) ends.push_back(&c.proofs);
    settle_files(held, ends, *this);
    settings_.placing.held = nullptr;
    settings_.checkpoint = nullptr;
    if (checkpoint) checkpoint_line_ = checkpoint->line();
  }

  void describe() {
    unit = found_.quantity.unit;
    closed = found_.is_closed();
    if (settings_.limit) {
      verdict = verdict_of(found_.verdict());
    } else {
      Facts facts(Readers::kPrograms);
      tell_bracket(request_, found_, settings_, facts);
      const Json report = facts.object();
      if (report["attained"].is_number()) attained = report["attained"];
      if (report["proved"].is_number()) proved = report["proved"];
    }
    for (const ComponentBound& c : found_.components)
      for (ProofOfEnd& proof : proofs_of_ends(c.proofs, c.component.label))
        proofs.push_back(std::move(proof));
  }

  Request request_;
  BoundSettings settings_;
  Bound found_;
  std::string checkpoint_line_;
};

class Sheet final : public DatasheetAnswer {
 public:
  Sheet(const AskDatasheet& asked, const Services& services)
      : request_(read(asked, services)), is_markdown_(asked.markdown) {
    settings_.gap = read_gap(asked.gap);
    settings_.search = asked.search;
    settings_.output = display_of(services);
    settings_.certificate = services.certificate;
    settings_.interrupt = services.interrupt;
    if (request_.model.closure) settings_.over_branch = bounds_over_branch();
    set_outputs_aside(asked.model, asked.search, services,
                      datasheet_files(request_, services.certificate));
    services.begin_search();
    if (services.on_line) services.tell(describe_request(request_));
    run(services);
  }

  [[nodiscard]] Word word() const override {
    // A sheet without a row answers nothing.
    bool is_closed = !found_.is_interrupted && !found_.bounds.empty();
    for (const Bound& bound : found_.bounds) {
      is_closed = is_closed && bound.is_closed();
      for (const ComponentBound& c : bound.components)
        if (c.is_singular() || limit_state(request_.model, c) == LimitState::kExceeded)
          return Word::kRefuted;
    }
    return is_closed ? Word::kProved : Word::kOpen;
  }
  [[nodiscard]] std::string headline() const override {
    return is_markdown_ ? markdown_datasheet(request_, found_, describe_request(request_))
                        : text_datasheet(request_, found_);
  }
  void tell(Facts& facts) const override { tell_datasheet(request_, found_, settings_, facts); }
  [[nodiscard]] std::string about_files() const override {
    std::string lines;
    for (const Bound& bound : found_.bounds)
      for (const ComponentBound& c : bound.components) lines += c.proofs.lines();
    return lines;
  }
  [[nodiscard]] std::string warning() const override { return checkpoint_line_; }

 private:
  static Request read(const AskDatasheet& asked, const Services& services) {
    const FormingWatch watch = watch_of(services, asked.search);
    return read_request(asked.model, &watch);
  }

  void run(const Services& services) {
    HeldFiles held;
    settings_.placing = {&held, services.shard_size};
    std::optional<BracketCheckpoint> checkpoint;
    if (!services.checkpoint.path.empty())
      settings_.checkpoint = &checkpoint.emplace(
          services.checkpoint.path, checkpointed_datasheet(request_, settings_.search));
    found_ = make_datasheet(request_, settings_, [](const ComponentBound&) {});
    std::vector<EndProofs*> ends;
    for (Bound& bound : found_.bounds)
      for (ComponentBound& c : bound.components) ends.push_back(&c.proofs);
    settle_files(held, ends, *this);
    settings_.placing.held = nullptr;
    settings_.checkpoint = nullptr;
    if (checkpoint) checkpoint_line_ = checkpoint->line();
    for (const Bound& bound : found_.bounds)
      for (const ComponentBound& c : bound.components)
        for (ProofOfEnd& proof : proofs_of_ends(c.proofs, c.component.label))
          proofs.push_back(std::move(proof));
  }

  Request request_;
  bool is_markdown_;
  BoundSettings settings_;
  Datasheet found_;
  std::string checkpoint_line_;
};

}  // namespace

std::unique_ptr<BoundAnswer> ask(const AskBound& asked, const Services& services) {
  const bool is_finite = is_finite_error(asked.quantity);
  refuse_services(is_finite ? Kind::kFiniteErrors : Kind::kBound, asked.model, asked.search,
                  services);
  if (is_finite)
    refuse_changed_options(option_refusals_of_closures(), asked.model, asked.search,
                           services.dashes);
  BoundQuestion question = read_bound_question(asked.model, asked.quantity, asked.limit,
                                               watch_of(services, asked.search));
  if (question.limit && !services.checkpoint.path.empty() &&
      question.quantity.kind != QuantityKind::kCondition2 && !question.request.model.closure)
    throw UsageError(services.dashes +
                     "checkpoint: with a limit there is one search and no bracket to continue");
  set_outputs_aside(asked.model, asked.search, services,
                    certificate_files(question.quantity, services.certificate));
  return std::make_unique<AnswerOfBound>(std::move(question), asked, services);
}

std::unique_ptr<DatasheetAnswer> ask(const AskDatasheet& asked, const Services& services) {
  refuse_threshold(asked.model);
  refuse_services(Kind::kDatasheet, asked.model, asked.search, services);
  return std::make_unique<Sheet>(asked, services);
}

}  // namespace regulus::detail
