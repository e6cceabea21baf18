// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/foresight.hpp"

#include <algorithm>
#include <new>
#include <utility>

#include "runtime/evaluation/regularity_tests.hpp"

namespace regulus::detail {
namespace {

/// Numbers below are those of boxes that may be among the first Course::kMost.
constexpr std::size_t kIds = 2 * Course::kMost + 1;

/// Tests that learn from one box for another, and tests that are not ours, must be asked in the
/// order of the search. The paper's order needs one box at a time.
bool decides_each_box_alone(const Problem& problem, const Settings& settings,
                            const RowStructure& structure) noexcept {
  return settings.batch == kLanes && !settings.exhaustive && settings.filters.empty() &&
         !tests_learn(problem, settings, structure);
}

}  // namespace

Foresight::Foresight(const Problem& problem, const Settings& settings,
                     const RowStructure& structure, std::size_t order)
    : problem_(problem),
      settings_(settings),
      order_(order),
      applies_(decides_each_box_alone(problem, settings, structure)),
      of_id_(applies_ ? kIds : 0),
      place_(applies_ ? kIds : 0),
      foreseen_(applies_ ? Course::kMost : 0) {
  for (Foreseen& next : foreseen_) next.box.resize(problem.kernel->variables);
}

void Foresight::learn_from(const Foresight& other) noexcept {
  *now_ = other.notes_ ? *other.now_ : *other.last_;
  now_->forget_splits();
  notes_ = applies_;
}

void Foresight::begin(std::span<const OpenBox> open, const SearchState& state) noexcept {
  if (notes_) std::swap(last_, now_);
  notes_ = applies_ && open.size() == 1 && open[0].id == 0 && state.next_id == 1;
  const bool has_closed_form = settings_.closed_form != nullptr;
  if (has_closed_form != had_closed_form_) last_->forget_splits();
  had_closed_form_ = has_closed_form;
  now_->size = ahead_ = used_batches_ = 0;
  // A search of one box has no lane to spare for it.
  foresees_ = notes_ && last_->size > 1;
}

void Foresight::note_box(const OpenBox& box) noexcept {
  if (!notes_) return;
  if (now_->size == Course::kMost || box.id >= kIds) {
    foresees_ = false;
    return;
  }
  const std::size_t place = now_->size++;
  place_[box.id] = static_cast<std::uint32_t>(place);
  id_[place] = box.id;
  now_->step[place] = of_id_[box.id];
  now_->split[place].reset();
  foresees_ = foresees_ && place < last_->size && now_->step[place] == last_->step[place];
}

void Foresight::note_split(const OpenBox& parent, std::uint32_t variable, BoxId first) noexcept {
  if (!notes_ || first + 1 >= kIds) return;
  of_id_[first] = {place_[parent.id], variable, false};
  of_id_[first + 1] = {place_[parent.id], variable, true};
}

Decisions* Foresight::room_for_batch() noexcept try {
  if (used_batches_ == batches_.size())
    batches_.push_back(std::make_unique<Decisions>(*problem_.kernel, order_));
  Decisions* batch = batches_[used_batches_++].get();
  batch->clear();
  return batch;
} catch (const std::bad_alloc&) {
  return nullptr;
}

/// Returns false if its parent has no such half.
bool Foresight::derive_box(std::size_t place) noexcept {
  Foreseen& next = foreseen_[place];
  next.batch = nullptr;
  if (place == 0) {
    std::copy(problem_.outer.begin(), problem_.outer.end(), next.box.begin());
    next.depth = 0;
    return true;
  }
  const Course::Step& step = last_->step[place];
  const Foreseen& parent = foreseen_[step.parent];
  const std::optional<Halves> halves = bisect(parent.box[step.variable]);
  if (!halves) return false;
  std::copy(parent.box.begin(), parent.box.end(), next.box.begin());
  next.box[step.variable] = step.second ? halves->right : halves->left;
  next.depth = parent.depth + 1;
  return true;
}

/// Decides the next eight boxes of the last search that were not split.
bool Foresight::foresee(Decider& decider) noexcept {
  Decisions* batch = room_for_batch();
  if (batch == nullptr) return false;
  for (; ahead_ < last_->size && batch->count() < kLanes; ++ahead_) {
    if (!derive_box(ahead_)) return false;
    Foreseen& next = foreseen_[ahead_];
    if (last_->split[ahead_]) continue;
    next.batch = batch;
    next.lane = batch->count();
    batch->add({0, next.depth, next.box});
  }
  if (batch->count() > 0) decider.decide(*batch, true);
  return true;
}

bool Foresight::take(Decisions& asked, std::size_t lane, std::size_t place) noexcept {
  const OpenBox& box = asked.open(lane);
  const Foreseen& known = foreseen_[place];
  if (box.depth != known.depth || !std::ranges::equal(box.box, known.box)) return false;
  known.batch != nullptr ? asked.take(lane, *known.batch, known.lane)
                         : asked.recall(lane, *last_->split[place]);
  return true;
}

std::optional<std::size_t> Foresight::place_of(const OpenBox& box) const noexcept {
  if (!notes_ || box.id >= kIds) return std::nullopt;
  const std::size_t place = place_[box.id];
  if (place >= now_->size || id_[place] != box.id) return std::nullopt;
  return place;
}

bool Foresight::decide(Decisions& asked, Decider& decider) noexcept {
  while (foresees_ && ahead_ < now_->size) foresees_ = foresee(decider);
  for (std::size_t lane = 0; lane < asked.count() && foresees_; ++lane)
    foresees_ = take(asked, lane, *place_of(asked.open(lane)));
  asked.decided = foresees_;
  return foresees_;
}

void Foresight::learn(const Decisions& batch) noexcept {
  for (std::size_t lane = 0; batch.decided && lane < batch.count(); ++lane)
    if (batch.decision[lane].kind == Decision::Kind::kSplit)
      if (const auto place = place_of(batch.open(lane)))
        now_->split[*place] = batch.recollection(lane);
}

}  // namespace regulus::detail
