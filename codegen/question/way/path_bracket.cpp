// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/path_bracket.hpp"

#include <algorithm>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/answer/report/progress.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/margin/variety_attempts.hpp"
#include "codegen/question/way/path_run.hpp"
#include "codegen/question/way/path_search.hpp"
#include "codegen/question/way/pieces_alone.hpp"
#include "codegen/question/way/trajectory_request.hpp"

namespace regulus::detail {
namespace {

/// The part of the gap below the witness at which all pieces are searched.
constexpr double kPartOfGap = 0.9;
/// The part of the gap that the bracket of a piece may have, so that it is closed at that value.
constexpr double kPartOfPiece = 0.5;
constexpr std::uint32_t kFewBoxes = 64;  ///< of a piece
/// A guess takes milliseconds.
constexpr std::size_t kMostGuesses = 16;
/// Some end is better than none.
constexpr int kHalvings = 12;

}  // namespace

PathBracket::PathBracket(const Request& request, const Request& alone,
                         const MarginQuestion& question, PathBracketSettings settings)
    : request_(request),
      alone_(alone),
      question_(question),
      settings_(std::move(settings)),
      path_(*request.motion.trajectory, request.motion.error),
      certified_(path_.pieces()),
      excluded_(path_.pieces(), false),
      undecided_(path_.pieces(), false) {
  settle_options(settings_.search);
  hull_.emplace(prepare(question, hull_request(request, path_)));
  settings_.budget.grant_least();
}

/// Forms the matrix in all of the time that is left.
PreparedMargin PathBracket::prepare(const MarginQuestion& question, Request request) {
  SearchOptions forming = settings_.search;
  forming.time_limit = TimeBudget::option(settings_.budget.all());
  PreparedMargin margin(question, std::move(request), 0, forming,
                        forming_watch(settings_.output, settings_.interrupt));
  margin.settings.interrupt = settings_.interrupt;
  seconds_ += margin.prepared.seconds_spent();
  return margin;
}

bool PathBracket::must_stop() const {
  return (settings_.interrupt != nullptr && *settings_.interrupt) || hull_->prepared.stopped ||
         settings_.budget.is_over();
}

bool PathBracket::is_certified(std::size_t piece, double value) const {
  return excluded_[piece] || (certified_[piece] && *certified_[piece] >= value);
}

std::vector<std::size_t> PathBracket::open_pieces(double value) const {
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < path_.pieces(); ++k)
    if (!is_certified(k, value) && !undecided_[k]) open.push_back(k);
  return open;
}

bool PathBracket::is_empty() const {
  return std::ranges::all_of(excluded_, [](bool excluded) { return excluded; });
}

std::optional<MarginValue> PathBracket::certified() const {
  std::optional<double> least;
  for (std::size_t k = 0; k < path_.pieces(); ++k) {
    if (excluded_[k]) continue;
    if (!certified_[k]) return std::nullopt;
    least = std::min(least.value_or(kInfinity), *certified_[k]);
  }
  return least ? std::optional(decimal_value(*least)) : std::nullopt;
}

/// Without a witness, the largest certified value: the pieces seem to have none. Without both, any
/// value: the constraints seem to exclude every pose.
MarginValue PathBracket::target(double gap) const {
  if (witness_) return decimal_value(witness_->step.value.approx * (1 - kPartOfGap * gap));
  double most = 0;
  for (const std::optional<double>& value : certified_) most = std::max(most, value.value_or(0));
  if (most > 0) return decimal_value(most);
  return question_.high.value_or(decimal_value(1));
}

/// Guesses at some pieces, then nearer and nearer to the best of them.
std::size_t PathBracket::most_promising(const std::vector<std::size_t>& pieces) const {
  const std::size_t last = pieces.size() - 1;
  std::size_t step = std::max<std::size_t>(1, pieces.size() / kMostGuesses), best = last / 2;
  if (last == 0) return pieces[0];
  double least = kInfinity;
  const auto look_at = [&](std::size_t i) {
    const std::optional<double> value =
        i <= last && !must_stop() ? settings_.guess(pieces[i]) : std::nullopt;
    if (!value || !(*value < least)) return;
    least = *value;
    best = i;
  };
  for (std::size_t i = step / 2; i <= last; i += step) look_at(i);
  for (std::size_t away = step / 2; away > 0; away /= 2) {
    const std::size_t middle = best;
    look_at(middle - std::min(middle, away));
    look_at(middle + away);
  }
  return pieces[best];
}

void PathBracket::close(double gap) {
  is_closed_ = false;
  if (!witness_ && !must_stop()) {
    std::vector<std::size_t> all(path_.pieces());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
    bracket_piece(most_promising(all), question_.high, gap);
    settings_.budget.grant_least();
  }
  while (!must_stop() && std::size_t(std::ranges::count(undecided_, true)) < kMostUndecidedPieces) {
    if (witness_ && witness_->step.value.approx == 0) break;
    const MarginValue value = target(gap);
    // Few boxes show most pieces to be below the largest value. The others are worth more only once
    // a piece that seemed to be above it was not.
    if (searched_.value != value.approx)
      search_together(value, kFewBoxes);
    else if (searched_.most_boxes == kFewBoxes)
      search_together(value, kMostBoxesOfPiece);
    const std::vector<std::size_t> open = open_pieces(value.approx);
    if (open.empty()) {
      is_closed_ = witness_ && std::ranges::count(undecided_, true) == 0;
      break;
    }
    bracket_piece(most_promising(open), value, gap);
  }
  certify_lower();
}

void PathBracket::search_together(const MarginValue& value, std::uint32_t most_boxes) {
  searched_ = {value.approx, most_boxes};
  hull_->request.replan(hull_->prepared, value);
  Settings settings = hull_->settings;
  settings.time_limit = settings_.budget.left();
  std::vector<bool> done(path_.pieces());
  for (std::size_t k = 0; k < done.size(); ++k) done[k] = is_certified(k, value.approx);
  SearchDisplay display(settings_.output);
  const PathSearchOptions options{request_.motion.parameters.size(),
                                  uncertain_names(hull_->prepared.labels).size(),
                                  false,
                                  hull_->prepared.labels.reach,
                                  most_boxes,
                                  &done,
                                  display.observer()};
  turn_to_piece(settings_.search.workers, settings_.topic, request_.motion, std::nullopt);
  const PathSearchResult found = search_path(path_, hull_->prepared.problem(), settings, options);
  boxes_ += found.statistics.boxes;
  seconds_.search += found.statistics.seconds;
  for (std::size_t k = 0; k < done.size(); ++k) {
    if (done[k] || !found.certified[k]) continue;
    excluded_[k] = found.leaves[k].are_excluded();
    certified_[k] = value.approx;
  }
}

void PathBracket::bracket_piece(std::size_t piece, std::optional<MarginValue> high, double gap) {
  MarginQuestion question = question_;
  question.high = std::move(high);
  PreparedMargin margin = prepare(question, piece_request(alone_, piece));
  if (!witness_) settings_.budget.grant_least();
  margin.settings.time_limit = margin.prepared.stopped ? 0 : settings_.budget.left() / 2;
  VarietyAttempts attempts(margin, question, settings_.output);
  const std::unique_ptr<EarlierSearches> earlier = settings_.earlier(piece, question);
  SearchTopic topic = settings_.topic;
  if (question.high) topic.high = question.high->approx;
  turn_to_piece(settings_.search.workers, std::move(topic), request_.motion, piece);
  Margin found = close_bracket(attempts, question,
                               {.limits = limits_of(margin.settings, kPartOfPiece * gap),
                                .interrupt = settings_.interrupt,
                                .earlier = earlier.get()});
  keep(piece, std::move(margin), std::move(found));
}

void PathBracket::keep(std::size_t piece, PreparedMargin margin, Margin found) {
  boxes_ += found.boxes;
  seconds_.search += found.seconds;
  if (found.certified)
    certified_[piece] = std::max(certified_[piece].value_or(0), found.certified->value.approx);
  excluded_[piece] = excluded_[piece] || (found.empty && !found.certified && !found.refuted);
  undecided_[piece] = !found.closed && !excluded_[piece];
  if (!found.refuted) return;
  if (witness_ && witness_->step.value.approx <= found.refuted->value.approx) return;
  witness_ = std::make_unique<PieceWitness>(
      PieceWitness{piece, std::move(margin), std::move(*found.refuted)});
}

/// Searches at smaller and smaller values while a piece is not certified above 0.
void PathBracket::certify_lower() {
  MarginValue value = target(0);
  const bool is_singular = witness_ && witness_->step.value.approx == 0;
  for (int i = 0; i < kHalvings && !is_singular && !must_stop(); ++i) {
    const std::optional<MarginValue> known = certified();
    if (is_empty() || (known && known->approx > 0)) return;
    value = decimal_value(value.approx / 2);
    search_together(value, kMostBoxesOfPiece);
  }
}

}  // namespace regulus::detail
