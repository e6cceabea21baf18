// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/rank_question.hpp"

#include <algorithm>
#include <memory>

#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/model/exact/decimal.hpp"
#include "codegen/question/bound/bound_question.hpp"
#include "codegen/question/bound/bracket_question.hpp"
#include "codegen/question/bound/datasheet.hpp"
#include "codegen/question/closure/branch_load.hpp"
#include "codegen/question/closure/branch_pieces.hpp"
#include "codegen/question/closure/branch_threshold.hpp"
#include "codegen/question/closure/closure_run.hpp"
#include "codegen/question/closure/value_judge.hpp"
#include "codegen/question/condition/box_judge.hpp"
#include "codegen/question/condition/condition_kernel.hpp"
#include "codegen/question/condition/path_judge.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/search_topic.hpp"
#include "codegen/question/load/feasibility_run.hpp"
#include "codegen/question/margin/prepared_margin.hpp"
#include "codegen/question/solve/rank_roots.hpp"
#include "codegen/question/solve/solve_run.hpp"
#include "codegen/question/solve/system_solutions.hpp"
#include "codegen/question/way/path_run.hpp"
#include "codegen/question/way/read_trajectory.hpp"
#include "codegen/question/way/regularity_judge.hpp"
#include "codegen/question/way/trajectory_request.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/search/box_judges.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

/// A kernel, and how boxes are decided with it.
struct Formed {
  PreparedSearch prepared;
  /// The problem of the searches, if it has other variables than the kernel.
  std::optional<Problem> searched{};
  /// Makes judges of boxes (runtime/search/box_judges.hpp) for a problem and settings, which outlive
  /// them; empty: the searches are those of Algorithm 1.
  std::function<cluster::MakeDecider(const Problem&, const Settings&)> judges{};
};

std::optional<MarginValue> value_of(std::optional<double> end) {
  return end ? std::optional(decimal_value(*end)) : std::nullopt;
}

/// An end of the bracket as it was written, unless a search has moved it.
void set_ends(MarginQuestion& question, const SearchTopic& topic) {
  const bool same_high = question.high && topic.high && question.high->approx == *topic.high;
  if (question.low.approx != topic.low) question.low = decimal_value(topic.low);
  if (!same_high) question.high = value_of(topic.high);
}

Formed about_forces(PreparedForces forces) {
  Formed question{std::move(forces.preparation)};
  question.judges = [problem_of_forces = std::move(forces.forces),
                     scaling = std::move(forces.scaling)](const Problem& problem, const Settings&) {
    return unit_judges<BoxForces>({problem_of_forces, problem, scaling});
  };
  return question;
}

Formed about_branch(PreparedClosure closed) {
  Formed question{std::move(closed.preparation), closed.problem};
  const auto branch = std::make_shared<const PreparedClosure>(std::move(closed));
  question.judges = [branch](const Problem& problem, const Settings&) {
    return unit_judges<TubeJudge>(
        {problem, branch->scaling, branch->shape, branch->near_start, branch->ranges});
  };
  return question;
}

Formed about_values(PreparedClosure closed, BranchValue of) {
  const auto value = std::make_shared<const BranchValue>(std::move(of));
  Formed question{std::move(closed.preparation), closed.problem};
  const auto branch = std::make_shared<const PreparedClosure>(std::move(closed));
  question.judges = [branch, value](const Problem& problem, const Settings&) {
    return unit_judges<ValueJudge>(
        {problem,
         {problem, branch->scaling, branch->shape, branch->near_start, branch->ranges},
         *value});
  };
  return question;
}

Formed about_equations(PreparedSystem system, std::size_t number) {
  Formed question{std::move(system.preparation), system.problem};
  const auto prepared = std::make_shared<const PreparedSystem>(std::move(system));
  question.judges = [prepared, number](const Problem& problem, const Settings&) {
    return unit_judges<RootJudge>(question_of_system(problem, *prepared, number));
  };
  return question;
}

Formed about_roots(RootSystems systems) {
  if (systems.unknowns == 0) throw cluster::MalformedMessage();
  Formed question{};
  question.searched.emplace().outer.resize(systems.unknowns);
  question.judges = [systems = std::move(systems)](const Problem& problem, const Settings&) {
    return unit_judges<RootJudge>(systems.question(problem));
  };
  return question;
}

/// A trajectory as the variety of a search, for all judges.
struct Path {
  Path(const Motion& motion, const Problem& kernel)
      : bounds(*motion.trajectory, motion.error),
        variety(bounds, kernel, motion.parameters.size()) {}

  const PathBounds bounds;
  const PathVariety variety;
};

Formed about_condition(const Motion& motion, PreparedSearch prepared) {
  Formed question{std::move(prepared)};
  const MatrixScaling scaling = question.prepared.stages->formulation().scaling;
  if (!motion.trajectory) {
    question.judges = [scaling](const Problem& problem, const Settings&) {
      return unit_judges<BoxJudge>({problem, scaling});
    };
    return question;
  }
  const auto path = std::make_shared<const Path>(motion, question.prepared.problem());
  question.searched = path->variety.problem();
  question.judges = [path, scaling](const Problem& problem, const Settings&) {
    return unit_judges<PathJudge>({problem, path->variety, scaling});
  };
  return question;
}

/// Forms what a topic names. What is not about a topic is formed within the limit of time, as by the
/// process that asks; a topic in any time, because that process ends the search.
class Topics {
 public:
  using Found = std::optional<Formed>;

  Topics(const Services& services, std::optional<std::string_view> topic)
      : certifies_(!services.certificate.empty()), is_told_(topic.has_value()) {
    if (topic) topic_ = read_topic(*topic);
  }

  Found operator()(const AskCheck& asked) const {
    if (const auto closed = read_closure(asked.model, {})) return on_branch(*closed, asked.search);
    if (const auto along = read_trajectory(asked.model)) return on_way(*along, asked.search);
    return Formed{prepare(asked.model, asked.search)};
  }

  Found operator()(const AskPaving& asked) const {
    if (const auto closed = read_closure(asked.model, {})) return on_branch(*closed, asked.search);
    ModelOptions model = asked.model;
    model.separates_reach = !certifies_;
    if (const auto along = read_trajectory(model)) return on_way(*along, asked.search);
    return Formed{prepare(model, asked.search)};
  }

  Found operator()(const AskLoad& asked) const { return loaded(asked); }
  Found operator()(const AskLoadPaving& asked) const { return loaded(asked); }

  Found operator()(const AskMargin& asked) const {
    ModelOptions model = asked.model;
    MarginQuestion question = take_question(model, asked.size);
    const bool has_limit = !asked.limit.empty();
    if (has_limit && !is_told_) return std::nullopt;
    Request request = has_limit ? read_asked(model, asked.quantity) : read_request(model);
    take_unit(question, request);
    if (!has_limit) return grown(question, std::move(request), asked.search);
    const Quantity quantity = quantity_of(request.model, asked.quantity);
    if (request.model.closure)
      return on_branch(at_value(question, request), component_of(quantity), asked.search);
    question = question_within_limit(std::move(question), component_of(quantity),
                                     read_limit(asked.limit, quantity));
    set_ends(question, topic_);
    return grown(question, std::move(request), asked.search);
  }

  Found operator()(const AskBound& asked) const {
    if (!is_told_) return std::nullopt;
    const BoundQuestion question = read_bound_question(asked.model, asked.quantity, asked.limit);
    if (question.request.model.closure)
      return on_branch(question.request, component_of(question.quantity), asked.search);
    if (is_about_condition(topic_)) return condition(question.request, asked.search);
    return bounded(question.request, question.quantity, question.limit, asked.search);
  }

  Found operator()(const AskDatasheet& asked) const {
    if (!is_told_) return std::nullopt;
    const Request request = read_request(asked.model);
    if (is_about_condition(topic_)) return condition(request, asked.search);
    const Quantity quantity = quantity_of_part(request, topic_.part);
    if (request.model.closure) return on_branch(request, component_of(quantity), asked.search);
    return bounded(request, quantity, std::nullopt, asked.search);
  }

  Found operator()(const AskSolve& asked) const {
    if (!is_told_) return std::nullopt;
    const Request request = read_solve_request(asked.model, {}, asked.held);
    if (auto equations = kernel_request(request))
      return about_equations(prepare_system(*std::move(equations), 0, forming(asked.search), {},
                                            DerivativesBy::kUnknowns),
                             topic_.piece.value_or(0));
    return about_roots(systems_of(request, asked.held, topic_.piece.value_or(0)));
  }

 private:
  [[nodiscard]] SearchOptions forming(SearchOptions search) const {
    if (is_told_) search.time_limit = 0;
    return search;
  }

  [[nodiscard]] const Component& component_of(const Quantity& quantity) const {
    const auto found = std::ranges::find(quantity.components, topic_.component, &Component::label);
    if (found == quantity.components.end()) throw cluster::MalformedMessage();
    return *found;
  }

  /// Throws    InputError for other way-points than those of the process that asks.
  void require_same_way(const Motion& motion) const {
    if (motion.trajectory && motion.trajectory->sha256 != topic_.waypoints)
      throw InputError::statement(motion.trajectory->file, 0,
                                  "the first rank has read other way-points from it",
                                  "put it where all ranks see the same");
  }

  /// Returns the request about one piece, or about the hull of all.
  [[nodiscard]] Request of_pieces(const Request& request, const Request& alone) const {
    require_same_way(request.motion);
    const Trajectory& trajectory = *request.motion.trajectory;
    if (!topic_.piece) return hull_request(request, PathBounds(trajectory, request.motion.error));
    if (*topic_.piece >= trajectory.pieces.size()) throw cluster::MalformedMessage();
    return piece_request(alone, *topic_.piece);
  }

  /// A piece alone is searched by Algorithm 1.
  [[nodiscard]] Found on_way(PreparedSearch prepared) const {
    Formed question{std::move(prepared)};
    if (!topic_.piece)
      question.judges = [](const Problem& problem, const Settings& settings) {
        return unit_judges<RegularityJudge>({problem, settings});
      };
    return question;
  }

  [[nodiscard]] Found on_way(const Request& request, SearchOptions search) const {
    if (!is_told_) return std::nullopt;
    settle_options(search);
    return on_way(prepare(of_pieces(request, request), 0, forming(search)));
  }

  template <class AskOfLoad>
  [[nodiscard]] Found loaded(const AskOfLoad& asked) const {
    if (auto closed = read_closure(asked.model, {})) {
      if (!is_told_) return std::nullopt;
      PreparedBranchLoad prepared =
          prepare_branch_load(std::move(*closed), 0, asked.load, forming(asked.search), {});
      BranchValue value = prepared.value();
      return on_branch(from_start_of_piece(std::move(prepared.branch.common()),
                                           prepared.branch.way().request.motion),
                       std::move(value));
    }
    std::optional<Request> along = read_trajectory(asked.model);
    if (!along) return about_forces(prepare_forces(asked.model, asked.load, asked.search, {}));
    if (!is_told_) return std::nullopt;
    SearchOptions search = asked.search;
    settle_options(search);
    along->motion.alpha = 0;
    return about_forces(
        prepare_forces(of_pieces(*along, *along), 0, asked.load, forming(search), {}));
  }

  /// Along way-points the kernel is that of all pieces; the search has the numbers of one, and the topic its
  /// start.
  [[nodiscard]] Found on_branch(const Request& request, const SearchOptions& search) const {
    if (!is_told_) return std::nullopt;
    PreparedClosure closed = closed_of(request, search, DerivativesBy::kVariables);
    if (!has_threshold(request)) return about_branch(std::move(closed));
    return on_branch(std::move(closed), value_at_threshold(request.model));
  }

  [[nodiscard]] PreparedClosure closed_of(Request request, const SearchOptions& search,
                                          DerivativesBy by) const {
    BranchInPieces branch(request, 0, forming(search), {}, by);
    return from_start_of_piece(std::move(branch.common()), request.motion);
  }

  /// Along way-points the kernel begins where the topic says, in the same file.
  [[nodiscard]] PreparedClosure from_start_of_piece(PreparedClosure closed,
                                                    const Motion& motion) const {
    if (!motion.trajectory) return closed;
    require_same_way(motion);
    if (topic_.start.size() != closed.shape.unknowns) throw cluster::MalformedMessage();
    closed.near_start.unknowns = topic_.start;
    return closed;
  }

  /// A question about values has two searches: the first is of the branch alone.
  [[nodiscard]] Found on_branch(PreparedClosure closed, BranchValue value) const {
    return topic_.kind == TopicKind::kQuestion ? about_values(std::move(closed), std::move(value))
                                               : about_branch(std::move(closed));
  }

  /// The component is of a model that outlives this call.
  [[nodiscard]] Found on_branch(Request request, const Component& component,
                                const SearchOptions& search) const {
    DerivativesBy by = BranchValue::needed(component.kind);
    if (topic_.kind == TopicKind::kBranch && by == DerivativesBy::kVariablesAndNominal)
      by = DerivativesBy::kVariables;
    PreparedClosure closed = closed_of(std::move(request), search, by);
    BranchValue value(closed.request.model, component);
    return on_branch(std::move(closed), std::move(value));
  }

  /// Throws    cluster::MalformedMessage for a topic without a value.
  [[nodiscard]] Request at_value(const MarginQuestion& question, Request request) const {
    if (!topic_.value) throw cluster::MalformedMessage();
    const MarginValue value = value_at(question, *topic_.value);
    return MarginRequest(std::move(request), question).at(value);
  }

  /// Along way-points, and of a closure, the searches are about one value of the bracket after the
  /// other.
  [[nodiscard]] Found grown(const MarginQuestion& question, Request request,
                            const SearchOptions& search) const {
    const bool is_closed = request.model.closure.has_value();
    if (is_closed || request.motion.trajectory) {
      if (!is_told_) return std::nullopt;
      Request grown = at_value(question, std::move(request));
      return is_closed ? on_branch(grown, search) : on_way(grown, search);
    }
    return Formed{std::move(
        PreparedMargin(question, std::move(request), 0, compiled_first(forming(search)), {})
            .prepared)};
  }

  [[nodiscard]] Found bounded(const Request& request, const Quantity& quantity,
                              const std::optional<ex>& limit, SearchOptions search) const {
    const Component& component = component_of(quantity);
    const Bordered bordered = limit
                                  ? border_at_limit(request, component, *limit)
                                  : border(request, component, shortest_decimal(topic_.reference));
    const MarginQuestion question =
        limit ? question_at_limit(bordered)
              : question_of(bordered, decimal_value(topic_.low), value_of(topic_.high));
    if (!request.motion.trajectory || topic_.value)
      return grown(question, bordered.request, search);
    // One kernel serves all values of a bracket.
    settle_options(search);
    const Request pieces = of_pieces(bordered.request, request_of_pieces(bordered));
    return on_way(std::move(PreparedMargin(question, pieces, 0, forming(search), {}).prepared));
  }

  [[nodiscard]] Formed condition(const Request& request, const SearchOptions& search) const {
    require_same_way(request.motion);
    return about_condition(request.motion, prepare_condition(topic_, request, search));
  }

  const bool certifies_, is_told_;
  SearchTopic topic_;
};

class FormedQuestion final : public RankQuestion {
 public:
  FormedQuestion(Formed formed, const SearchOptions& options)
      : formed_(std::move(formed)), options_(options) {}

  void decide_for_another(const cluster::SearchDescription& search, const Decide& decide) override {
    if (!formed_.judges)
      return detail::decide_for_another(
          formed_.prepared, options_, search,
          [&](const Problem& problem, const Settings& settings) { decide(problem, settings, {}); });
    const Problem problem = problem_of_another(
        formed_.searched ? *formed_.searched : formed_.prepared.problem(), search);
    decide(problem, search.settings, formed_.judges(problem, search.settings));
  }

 private:
  Formed formed_;
  const SearchOptions options_;
};

}  // namespace

std::unique_ptr<RankQuestion> prepare_for_rank(const Asked& asked, const Services& services,
                                               std::optional<std::string_view> topic) {
  std::optional<Formed> formed = std::visit(Topics(services, topic), asked);
  if (!formed) return nullptr;
  // The other process may have formed it in time, and this kernel is for reports only.
  if (formed->prepared.stopped)
    throw InternalError("the time limit was reached before the question was prepared");
  return std::make_unique<FormedQuestion>(
      std::move(*formed), std::visit([](const auto& one) { return one.search; }, asked));
}

}  // namespace regulus::detail
