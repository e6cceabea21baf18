// SPDX-License-Identifier: GPL-3.0-or-later
// How far can a range, a tolerance or a control error grow with the branch of a closure regular?
#include "codegen/answer/bracket_ends.hpp"
#include "codegen/answer/closure_answer.hpp"
#include "codegen/answer/outputs.hpp"
#include "codegen/model/request.hpp"
#include "codegen/question/closure/closure_claims.hpp"
#include "codegen/question/closure/closure_margin.hpp"
#include "codegen/question/closure/closure_way_report.hpp"
#include "codegen/question/margin/margin_certificates.hpp"
#include "codegen/question/margin/margin_report.hpp"
#include "codegen/question/margin/margin_run.hpp"
#include "codegen/question/margin/prepared_margin.hpp"
#include "codegen/question/way/margin_checkpoint.hpp"
#include "codegen/question/way/path_attempts.hpp"

namespace regulus::detail {
namespace {

/// `Checked`: over ranges or along way-points.
template <class Checked>
class ClosureMargin final : public MarginAnswer {
 public:
  ClosureMargin(const MarginQuestion& question, Request request, const AskMargin& asked,
                const Services& services)
      : question_(question),
        search_(asked.search),
        gap_(read_gap(asked.gap)),
        request_(std::move(request), question_) {
    services.begin_search();
    const MarginCheckpoint checkpoint(services.checkpoint.path, request_.nominal(), question_,
                                      search_);
    HeldFiles held;
    const OutputOptions display = display_of(services);
    attempts_.emplace(request_, search_, display, services.interrupt,
                      margin_proofs(services.certificate, {&held, services.shard_size}));
    found_ = close_bracket(*attempts_, question_,
                           {limits_of(search_, gap_), services.interrupt,
                            steps_of(question_, services), checkpoint.searches()});
    ends_ = attempts_->proofs();
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
    const auto& shown = attempts_->refuted() ? attempts_->refuted() : attempts_->last();
    if (!shown) return;
    tell_bracket(*shown, facts);
    ends_.tell(facts);
  }
  [[nodiscard]] std::string about_files() const override { return ends_.lines(); }
  [[nodiscard]] std::string warning() const override { return checkpoint_line_; }

 private:
  void tell_bracket(const CheckedBranch& shown, Facts& facts) const {
    tell_margin(shown.prepared.preparation, search_, request_.nominal(), question_, found_, gap_,
                facts);
    tell_branch(shown.prepared, shown.found.searched.links, shown.found.folds, facts);
    tell_below(shown.prepared, nullptr, shown.found.threshold, facts);
  }
  void tell_bracket(const CheckedBranchOnWay& shown, Facts& facts) const {
    tell_way_margin(shown.prepared, search_, shown.found, question_, found_, gap_, facts);
  }

  MarginQuestion question_;
  SearchOptions search_;
  double gap_;
  MarginRequest request_;
  std::optional<ClosureAttempts<Checked>> attempts_;
  Margin found_;
  EndProofs ends_;
  std::string checkpoint_line_;
};

}  // namespace

std::unique_ptr<MarginAnswer> answer_closure(const MarginQuestion& question, Request request,
                                             const AskMargin& asked, const Services& services) {
  if (request.motion.trajectory)
    return std::make_unique<ClosureMargin<CheckedBranchOnWay>>(question, std::move(request), asked,
                                                               services);
  return std::make_unique<ClosureMargin<CheckedBranch>>(question, std::move(request), asked,
                                                        services);
}

}  // namespace regulus::detail
