// SPDX-License-Identifier: GPL-3.0-or-later
// Answers which configurations, poses or postures there are at one place.
#include "codegen/answer/ask.hpp"
#include "codegen/answer/outputs.hpp"
#include "codegen/answer/refusals.hpp"
#include "codegen/answer/report/progress.hpp"
#include "codegen/question/solve/solve_certificate.hpp"
#include "codegen/question/solve/solve_report.hpp"
#include "codegen/question/solve/solve_run.hpp"

namespace regulus {
namespace {

class FoundSolutions final : public SolveAnswer {
 public:
  FoundSolutions(const AskSolve& asked, const Services& services)
      : search_(asked.search),
        request_(read_solve_request(asked.model, watch_of(services, search_))) {
    if (!services.certificate.empty()) refuse_proof_of_solutions(request_, services);
    set_outputs_aside(asked.model, asked.search, services);
    SearchDisplay display(display_of(services));
    SolveRun run{search_,
                 watch_of(services, search_),
                 services.interrupt,
                 display.observer(),
                 [&services] { services.begin_search(); },
                 asked.held};
    noun = noun_of(request_);
    solutions = solve(request_, run);
    proof_ = certify_solutions(services.certificate, request_, solutions, {});
    if (proof_.is_lost()) lost.push_back(proof_.obstacle());
  }

  void tell(Facts& facts) const override {
    tell_solutions(request_, search_, solutions, noun, facts);
    proof_.tell(facts);
  }
  [[nodiscard]] std::string about_files() const override { return proof_.line(); }

 private:
  SearchOptions search_;
  Request request_;
  ProofStatus proof_;
};

}  // namespace

Word SolveAnswer::word() const {
  if (solutions.completeness == Completeness::kIncomplete) return Word::kOpen;
  return solutions.found.empty() ? Word::kRefuted : Word::kProved;
}

std::string SolveAnswer::headline() const { return describe_result(solutions, noun); }

std::unique_ptr<SolveAnswer> ask(const AskSolve& asked, const Services& services) {
  refuse_changed_options(option_refusals_of_solutions(), asked.model, asked.search);
  refuse_services(Kind::kSolve, asked.model, asked.search, services);
  return std::make_unique<FoundSolutions>(asked, services);
}

}  // namespace regulus
