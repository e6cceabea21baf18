// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/sides_search.hpp"

#include <algorithm>

#include "codegen/question/analysis/undefined.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/question/way/trajectory_certificate.hpp"
#include "runtime/problem/observers.hpp"

namespace regulus::detail {
namespace {

/// The box of a witness: its path lies in it.
std::vector<Interval> hull_of(const Witness& witness) {
  std::vector<Interval> box;
  for (const WitnessPoint& point : witness.points) {
    if (box.empty()) box = point.variables;
    for (std::size_t k = 0; k < box.size(); ++k) box[k] = hull(box[k], point.variables[k]);
  }
  return box;
}

void add(const Statistics& more, Statistics& all) {
  all.boxes += more.boxes;
  all.max_frontier = std::max(all.max_frontier, more.max_frontier);
  for (std::size_t rule = 0; rule < kRules; ++rule) all.leaves[rule] += more.leaves[rule];
  all.seconds += more.seconds;
}

double seconds_of(const StageSeconds& s) { return s.before_search() + s.search; }

class SidesSearch {
 public:
  SidesSearch(const CutSides& sides, PreparedSearch& whole, const Result& open,
              const SearchOptions& search, const std::atomic<bool>* interrupt, Observer* display)
      : sides_(sides),
        whole_(whole),
        search_(search),
        limit_(search.time_limit),
        interrupt_(interrupt),
        display_(display),
        definedness_(whole.stages->natural_formulation()),
        decision_{open, std::vector<TreeKept>(sides.count())} {
    search_.workers = nullptr;  // They have prepared the question itself.
  }

  std::optional<SidesDecision> run() {
    bool has_pose = false;
    for (std::size_t number = 0; number < sides_.count(); ++number) {
      const std::optional<Result> result = search_side(number);
      if (!result) return std::nullopt;
      if (result->verdict == Verdict::kSingularity) return singular_at(*result);
      const bool is_empty = result->reason == Reason::kEmptyVariety;
      if (result->verdict != Verdict::kNoSingularity && !is_empty) return std::nullopt;
      has_pose |= !is_empty;
    }
    if (!has_pose) return std::nullopt;
    Result& all = decision_.result;
    all.verdict = Verdict::kNoSingularity;
    all.reason = Reason::kAllBoxesCertified;
    all.blocking_box.clear();
    return std::move(decision_);
  }

 private:
  /// Returns nullopt if no time is left.
  std::optional<Result> search_side(std::size_t number) {
    if (limit_ > 0) search_.time_limit = limit_ - seconds_of(whole_.seconds_spent());
    if (limit_ > 0 && search_.time_limit <= 0) return std::nullopt;
    PreparedSearch prepared = prepare(sides_.on_sides(number), 0, search_);
    Observers observers(present({&decision_.trees[number], display_}));
    Result result =
        run_search(prepared, search_, settings_of(prepared, search_, interrupt_), &observers);
    whole_.seconds += prepared.seconds_spent();
    whole_.bits = std::max(whole_.bits, prepared.bits);
    add(result.statistics, decision_.result.statistics);
    return result;
  }

  /// Off the cuts the matrix of the sides is the matrix, and a path does not jump. That a determinant
  /// is 0 identically is known of one side alone.
  std::optional<SidesDecision> singular_at(const Result& result) {
    if (!result.witness || result.reason == Reason::kAlwaysSingular) return std::nullopt;
    if (!definedness_.certain_on(hull_of(*result.witness))) return std::nullopt;
    const Statistics statistics = decision_.result.statistics;
    decision_.result = result;
    decision_.result.statistics = statistics;
    return std::move(decision_);
  }

  const CutSides& sides_;
  PreparedSearch& whole_;
  SearchOptions search_;
  const double limit_;
  const std::atomic<bool>* const interrupt_;
  Observer* const display_;
  const Definedness definedness_;
  SidesDecision decision_;
};

}  // namespace

std::optional<SidesDecision> search_sides(const CutSides& sides, PreparedSearch& whole,
                                          const Result& open, const SearchOptions& search,
                                          const std::atomic<bool>* interrupt, Observer* display) {
  return SidesSearch(sides, whole, open, search, interrupt, display).run();
}

ProofStatus certify_sides(const std::string& path, const CutSides& sides,
                          const PreparedSearch& whole, const SidesDecision& decision,
                          const ProofPlacing& placing) {
  ProofStatus status(path);
  if (!status.is_wanted()) return status;
  const bool is_singular = decision.result.verdict == Verdict::kSingularity;
  const CertifiedQuestion question =
      is_singular ? certified_question(whole) : sides.on_all_sides(uncertain_names(whole.labels));
  status.set_obstacle(certificate_obstacle(question, is_singular));
  if (!status.obstacle().empty()) return status;
  status.attempt([&] {
    if (is_singular)
      write_witness(path, question.head(true), witness_lines(decision.result), placing);
    else
      write_pieces(path, question.head(false), decision.trees, certificate_word, placing);
    status.set_written();
  });
  return status;
}

}  // namespace regulus::detail
