// SPDX-License-Identifier: GPL-3.0-or-later
// A branch of a closure that is followed along way-points.
#include "codegen/answer/closure_answer.hpp"
#include "codegen/answer/outputs.hpp"
#include "codegen/answer/report/progress.hpp"
#include "codegen/model/request.hpp"
#include "codegen/question/closure/closure_certificate.hpp"
#include "codegen/question/closure/closure_way_report.hpp"

namespace regulus {
namespace {

/// The answer has no `variables`, as that of other motions along way-points.
class ClosureWayCheck final : public CheckAnswer {
 public:
  ClosureWayCheck(Request request, double model_seconds, const AskCheck& asked,
                  const Services& services)
      : search_(asked.search),
        prepared_(
            prepare_way(std::move(request), model_seconds, search_, watch_of(services, search_))) {
    services.begin_search();
    SearchDisplay display(display_of(services));
    found_ = check_way(prepared_, search_, watch_of(services, search_), display.observer());
    proof = certify_way(services.certificate, prepared_, found_, {nullptr, services.shard_size});
    if (proof.is_lost()) lost.push_back(proof.obstacle());
    result = found_.result;
  }

  [[nodiscard]] std::string claim() const override { return describe_claim(prepared_, found_); }
  void tell(Facts& facts) const override {
    tell_closure_way(prepared_, search_, found_, facts);
    proof.tell(facts);
  }
  [[nodiscard]] std::string about_files() const override { return proof.line(); }

 private:
  SearchOptions search_;
  PreparedWay prepared_;
  WayFinding found_;
};

}  // namespace

std::unique_ptr<CheckAnswer> answer_closure_way(Request request, double model_seconds,
                                                const AskCheck& asked, const Services& services) {
  return std::make_unique<ClosureWayCheck>(std::move(request), model_seconds, asked, services);
}

}  // namespace regulus
