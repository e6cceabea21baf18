// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/foresight.hpp"

#include <algorithm>
#include <new>

#include "runtime/evaluation/regularity_tests.hpp"

namespace regulus {
namespace {

/// Numbers up to here are those of boxes that may be among the first kMost.
constexpr std::size_t kIds = 2 * Foresight::kMost + 1;

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
      order_(order),
      applies_(decides_each_box_alone(problem, settings, structure)),
      of_id_(applies_ ? kIds : 0),
      place_(applies_ ? kIds : 0),
      box_(problem.kernel->variables) {}

void Foresight::begin(std::span<const OpenBox> open, const SearchState& state) noexcept {
  if (notes_) last_ = now_;
  notes_ = applies_ && open.size() == 1 && open[0].id == 0 && state.next_id == 1;
  now_.size = ahead_ = 0;
  // A search of one box has no lane to spare for it.
  foresees_ = notes_ && last_.size > 1;
}

void Foresight::note_box(const OpenBox& box) noexcept {
  if (!notes_) return;
  if (now_.size == kMost || box.id >= kIds) {
    foresees_ = false;
    return;
  }
  const std::size_t place = now_.size++;
  place_[box.id] = static_cast<std::uint32_t>(place);
  now_.step[place] = of_id_[box.id];
  foresees_ = foresees_ && place < last_.size && now_.step[place] == last_.step[place];
}

void Foresight::note_split(const OpenBox& parent, std::uint32_t variable, BoxId first) noexcept {
  if (!notes_ || first + 1 >= kIds) return;
  of_id_[first] = {place_[parent.id], variable, false};
  of_id_[first + 1] = {place_[parent.id], variable, true};
}

Decisions* Foresight::room_for_batch(std::size_t batch) noexcept try {
  if (batch == batches_.size())
    batches_.push_back(std::make_unique<Decisions>(*problem_.kernel, order_));
  batches_[batch]->clear();
  return batches_[batch].get();
} catch (const std::bad_alloc&) {
  return nullptr;
}

/// Adds the box of a step; false: its parent has no such halves.
bool Foresight::add(const Step& step, Decisions& batch) noexcept {
  Decisions& of_parent = *batches_[step.parent / kLanes];
  const OpenBox& parent = of_parent.open(step.parent % kLanes);
  std::copy(parent.box.begin(), parent.box.end(), box_.begin());
  const std::optional<Halves> halves = bisect(box_[step.variable]);
  if (!halves) return false;
  box_[step.variable] = step.second ? halves->right : halves->left;
  batch.add({0, parent.depth + 1, box_});
  return true;
}

/// Decides the next eight boxes of the last search.
bool Foresight::decide_ahead(Decider& decider) noexcept {
  Decisions* batch = room_for_batch(ahead_ / kLanes);
  if (batch == nullptr) return false;
  const std::size_t end = std::min(ahead_ + kLanes, last_.size);
  for (std::size_t place = ahead_; place < end; ++place) {
    if (place == 0)
      batch->add({0, 0, problem_.outer});
    else if (!add(last_.step[place], *batch))
      return false;
  }
  decider.decide(*batch, true);
  ahead_ = end;
  return true;
}

bool Foresight::decide(Decisions& asked, Decider& decider) noexcept {
  if (!foresees_) return false;
  const std::size_t first = now_.size - asked.count();
  while (ahead_ < now_.size && foresees_) foresees_ = decide_ahead(decider);
  for (std::size_t lane = 0; lane < asked.count() && foresees_; ++lane) {
    const Decisions& ahead = *batches_[(first + lane) / kLanes];
    const OpenBox &box = asked.open(lane), &foreseen = ahead.open((first + lane) % kLanes);
    foresees_ = box.depth == foreseen.depth && std::ranges::equal(box.box, foreseen.box);
    if (foresees_) asked.take(lane, ahead, (first + lane) % kLanes);
  }
  asked.decided = foresees_;
  return foresees_;
}

}  // namespace regulus
