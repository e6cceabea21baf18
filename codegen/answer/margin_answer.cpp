// SPDX-License-Identifier: GPL-3.0-or-later
// How far can a tolerance, the threshold or a size grow?
#include <nlohmann/json.hpp>

#include "codegen/answer/ask.hpp"
#include "codegen/answer/bracket_ends.hpp"
#include "codegen/answer/closure_answer.hpp"
#include "codegen/answer/outputs.hpp"
#include "codegen/answer/refusals.hpp"
#include "codegen/model/degrees.hpp"
#include "codegen/question/bound/bound_question.hpp"
#include "codegen/question/bound/bound_run.hpp"
#include "codegen/question/bound/limit_margin.hpp"
#include "codegen/question/bound/quantity_report.hpp"
#include "codegen/question/closure/branch_margin.hpp"
#include "codegen/question/margin/margin_report.hpp"
#include "codegen/question/margin/prepared_margin.hpp"
#include "codegen/question/margin/variety_attempts.hpp"
#include "codegen/question/way/margin_checkpoint.hpp"
#include "codegen/question/way/trajectory_margin.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

/// Values of an angle may be meant in degrees.
void warn_about_values(const MarginQuestion& question, const ModelOptions& model) {
  const bool is_beyond = question.high && question.high->approx > kOneTurn;
  if (model.warn && question.unit == "rad" && is_beyond)
    model.warn("the values are in rad, and " + question.high->text + " is more than a turn");
}

class VarietyMargin final : public MarginAnswer {
 public:
  VarietyMargin(const MarginQuestion& question, Request request, const AskMargin& asked,
                const Services& services)
      : question_(question),
        gap_(read_gap(asked.gap)),
        margin_(question_, std::move(request), 0, compiled_first(asked.search),
                watch_of(services)) {
    margin_.settings.interrupt = services.interrupt;
    services.begin_search();
    const MarginCheckpoint checkpoint(services.checkpoint.path, margin_.request.nominal(),
                                      question_, asked.search);
    HeldFiles held;
    const OutputOptions display = display_of(services);
    VarietyAttempts attempts(margin_, question_, display,
                             margin_proofs(services.certificate, {&held, services.shard_size}));
    found_ = close_bracket(attempts, question_,
                           {limits_of(margin_.settings, gap_), services.interrupt,
                            steps_of(question_, services), checkpoint.searches()});
    margin_.prepared.seconds.search = found_.seconds;
    ends_ = attempts.proofs();
    settle_files(held, {&ends_}, *this);
    checkpoint_line_ = checkpoint.line();
    set_ends(*this, found_);
    proofs = proofs_of_ends(ends_, "");
  }

  [[nodiscard]] Word word() const override { return word_of(question_, found_); }
  [[nodiscard]] std::string headline() const override {
    return describe_bracket(question_, found_);
  }
  void tell(Facts& facts) const override {
    tell_margin(margin_.prepared, margin_.search, margin_.request.nominal(), question_, found_,
                gap_, facts);
    ends_.tell(facts);
  }
  [[nodiscard]] std::string about_files() const override { return ends_.lines(); }
  [[nodiscard]] std::string warning() const override { return checkpoint_line_; }

 private:
  MarginQuestion question_;
  double gap_;
  PreparedMargin margin_;
  Margin found_;
  EndProofs ends_;
  std::string checkpoint_line_;
};

/// The answer for a motion along way-points.
class WayMargin final : public MarginAnswer {
 public:
  WayMargin(const MarginQuestion& question, Request request, const AskMargin& asked,
            const Services& services)
      : question_(question),
        search_(asked.search),
        gap_(read_gap(asked.gap)),
        request_(std::move(request), question_) {
    services.begin_search();
    const MarginCheckpoint checkpoint(services.checkpoint.path, request_.nominal(), question_,
                                      search_);
    HeldFiles held;
    found_ = margin_of_trajectory(
        request_, question_, search_, gap_, display_of(services),
        {{}, services.interrupt, steps_of(question_, services), checkpoint.searches()},
        margin_proofs(services.certificate, {&held, services.shard_size}));
    settle_files(held, {&found_.proofs}, *this);
    checkpoint_line_ = checkpoint.line();
    set_ends(*this, found_.margin);
    proofs = proofs_of_ends(found_.proofs, "");
  }

  [[nodiscard]] Word word() const override { return word_of(question_, found_.margin); }
  [[nodiscard]] std::string headline() const override {
    return describe_bracket(question_, found_.margin);
  }
  void tell(Facts& facts) const override {
    tell_trajectory_margin(found_, question_, search_, gap_, facts);
  }
  [[nodiscard]] std::string about_files() const override { return found_.proofs.lines(); }
  [[nodiscard]] std::string warning() const override { return checkpoint_line_; }

 private:
  MarginQuestion question_;
  SearchOptions search_;
  double gap_;
  MarginRequest request_;
  TrajectoryMargin found_;
  std::string checkpoint_line_;
};

/// Returns everything that the bracket of a limit depends on.
Json checkpointed(const Request& request, const MarginQuestion& question, const Quantity& quantity,
                  const AskMargin& asked) {
  Json text = checkpointed_question(request, quantity, asked.search);
  text["margin"] = describe_quantity(question);
  text["limit"] = asked.limit;
  return text;
}

/// The answer for a limit that a quantity must keep.
class MarginOfLimit final : public MarginAnswer {
 public:
  MarginOfLimit(const MarginQuestion& question, const ModelOptions& model, const AskMargin& asked,
                const Services& services)
      : question_(question),
        request_(read_asked(model, asked.quantity, watch_of(services, asked.search))) {
    is_of_limit = true;
    take_unit(question_, request_);
    warn_about_values(question_, model);
    Quantity quantity = quantity_of(request_.model, asked.quantity);
    settings_.gap = read_gap(asked.gap);
    settings_.limit = read_limit(asked.limit, quantity);
    question_.limit = describe_limit(quantity, settings_.limit);
    settings_.search = asked.search;
    settings_.output = display_of(services);
    settings_.certificate = services.certificate;
    settings_.interrupt = services.interrupt;
    if (request_.model.closure) settings_.over_branch = margin_over_branch;
    set_outputs_aside(model, asked.search, services,
                      certificate_files(quantity, services.certificate));
    services.begin_search();
    const Json question_of_file = checkpointed(request_, question_, quantity, asked);
    run(question_of_file, std::move(quantity), services);
  }

  [[nodiscard]] Word word() const override {
    const Word word = word_of(question_, found_.whole);
    return word == Word::kOpen && closed ? Word::kProved : word;
  }
  [[nodiscard]] std::string headline() const override {
    return describe_limit_bracket(question_, found_);
  }
  void tell(Facts& facts) const override {
    tell_limit_margin(request_, question_, found_, settings_, facts);
  }
  [[nodiscard]] std::string warning() const override { return checkpoint_line_; }

 private:
  void run(const Json& checkpointed, Quantity quantity, const Services& services) {
    HeldFiles held;
    settings_.placing = {&held, services.shard_size};
    std::optional<BracketCheckpoint> checkpoint;
    if (!services.checkpoint.path.empty())
      settings_.checkpoint = &checkpoint.emplace(services.checkpoint.path, checkpointed);
    found_ = limit_margin(request_, question_, std::move(quantity), settings_,
                          steps_of(question_, services));
    std::vector<EndProofs*> ends;
    for (ComponentMargin& c : found_.components) ends.push_back(&c.proofs);
    settle_files(held, ends, *this);
    settings_.placing.held = nullptr;
    settings_.checkpoint = nullptr;
    if (checkpoint) checkpoint_line_ = checkpoint->line();
    set_ends(*this, found_.whole);
    for (const ComponentMargin& c : found_.components)
      for (ProofOfEnd& proof : proofs_of_ends(c.proofs, c.component.label))
        proofs.push_back(std::move(proof));
  }

  MarginQuestion question_;
  Request request_;
  LimitMarginSettings settings_;
  LimitMargin found_;
  std::string checkpoint_line_;
};

}  // namespace

std::unique_ptr<MarginAnswer> ask(const AskMargin& asked, const Services& services) {
  const bool has_limit = !asked.limit.empty(), has_quantity = !asked.quantity.quantity.empty();
  if (has_limit != has_quantity)
    throw UsageError("margin: " + services.dashes + "quantity and " + services.dashes +
                     "limit need each other");
  ModelOptions model = asked.model;
  static_cast<void>(read_gap(asked.gap));
  MarginQuestion question = take_question(model, asked.size);
  const bool is_finite = has_limit && is_finite_error(asked.quantity);
  refuse_services(is_finite   ? Kind::kFiniteErrors
                  : has_limit ? Kind::kLimitMargin
                              : Kind::kMargin,
                  model, asked.search, services);
  if (is_finite)
    refuse_changed_options(option_refusals_of_closures(), model, asked.search, services.dashes);
  if (has_limit) return std::make_unique<MarginOfLimit>(question, model, asked, services);
  set_outputs_aside(model, asked.search, services, EndProofs::files(services.certificate));
  const FormingWatch watch = watch_of(services, asked.search);
  Request request = read_request(model, &watch);
  take_unit(question, request);
  question.has_threshold =
      question.quantity == MarginQuantity::kAlpha || !request.motion.alpha.is_zero();
  warn_about_values(question, asked.model);
  if (request.model.closure) return answer_closure(question, std::move(request), asked, services);
  if (!request.motion.trajectory)
    return std::make_unique<VarietyMargin>(question, std::move(request), asked, services);
  return std::make_unique<WayMargin>(question, std::move(request), asked, services);
}

}  // namespace regulus::detail
