// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/condition_kernel.hpp"

#include <algorithm>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/question/quantity/inverse_in_one_unit.hpp"
#include "codegen/question/way/trajectory_request.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

/// With more variables the second derivatives of Taylor's expansion are too many.
constexpr std::size_t kMostExpanded = 12;

bool may_expand(const Request& request) {
  const auto moves = [](const GiNaC::ex& error) { return !error.is_zero(); };
  const auto errors = std::size_t(std::ranges::count_if(request.motion.error, moves));
  return uncertain_names(request).size() + request.motion.parameters.size() + errors <=
         kMostExpanded;
}

/// The kernel needs the entries of the matrix and the expansion of K·A, in which every quantity is
/// treated alike; of a model with many uncertain quantities, only derivatives of the entries.
SearchOptions options_of_kernel(SearchOptions search, bool expands) {
  search.method = expands ? Method::kAuto : Method::kReg;
  search.entries = expands ? Entries::kNatural : Entries::kDerivatives;
  search.uncertainty = Uncertainty::kElements;
  for (const char* ingredient : {"columns", "rows"})
    if (std::ranges::find(search.without, ingredient) == search.without.end())
      search.without.emplace_back(ingredient);
  return search;
}

/// True if Taylor's expansion was formed: not if it was too costly.
bool has_expansion(const PreparedSearch& prepared) {
  const regulus_kernel& kernel = *prepared.problem().kernel;
  if (kernel.expansion == nullptr) return false;
  const int* rows = kernel.expansion->row_of_variable;
  return rows != nullptr && std::all_of(rows, rows + kernel.variables, [](int r) { return r < 0; });
}

/// Returns the question about every pose that the kernel must reach: of a trajectory, its hull.
Request reached_by(const Request& request) {
  if (!request.motion.trajectory) return request;
  return hull_request(request, PathBounds(*request.motion.trajectory, request.motion.error));
}

PreparedSearch form_kernel(const Request& request, const SearchOptions& search, bool expands,
                           const FormingWatch& watch) {
  return prepare(inverse_in_one_unit(request), 0, options_of_kernel(search, expands), watch);
}

}  // namespace

ConditionKernel form_condition_kernel(const Request& request, const SearchOptions& search,
                                      const FormingWatch& watch) {
  const Request reached = reached_by(request);
  bool expands = may_expand(reached);
  PreparedSearch prepared = form_kernel(reached, search, expands, watch);
  if (expands && !prepared.stopped && !has_expansion(prepared)) {
    expands = false;
    prepared = form_kernel(reached, search, expands, watch);
  }
  return {std::move(prepared), expands};
}

SearchTopic topic_of(const ConditionKernel& kernel) {
  SearchTopic topic;
  topic.kind = kernel.is_expanded ? TopicKind::kExpandedMatrix : TopicKind::kMatrixWithSlopes;
  return topic;
}

bool is_about_condition(const SearchTopic& topic) {
  return topic.kind == TopicKind::kExpandedMatrix || topic.kind == TopicKind::kMatrixWithSlopes;
}

PreparedSearch prepare_condition(const SearchTopic& topic, const Request& request,
                                 const SearchOptions& search) {
  const bool expands = topic.kind == TopicKind::kExpandedMatrix;
  SearchOptions forming = search;
  forming.time_limit = 0;  // the process that asks ends the search
  PreparedSearch prepared = form_kernel(reached_by(request), forming, expands, {});
  if (expands && !prepared.stopped && !has_expansion(prepared))
    throw InternalError("the ranks have formed different matrices");
  return prepared;
}

}  // namespace regulus::detail
