// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/leaf_proofs.hpp"

#include <flint/flint.h>

#include <chrono>
#include <utility>

#include "runtime/verifier/usual_environment.hpp"

namespace regulus::verifier {
namespace {

/// A batch is small, so that a proof of a few leaves also has work for several threads.
constexpr std::size_t kLeavesOfBatch = 16;
/// The first batches look for a point of the variety; a claim about no point has no value.
constexpr std::size_t kBatchesForPoints = 4;
/// The reader is ahead by so many batches for each thread.
constexpr std::size_t kBatchesAhead = 4;
constexpr auto kBetweenTicks = std::chrono::milliseconds(50);

constexpr const char* kOppositeSigns =
    "the determinant has opposite signs at two points of the variety, one of them in it";

}  // namespace

LeafProofs::LeafProofs(Question& question, const Variety& variety, const Options& options,
                       WorkClock& clock, Verification& counts)
    : question_(question), variety_(variety), options_(options), clock_(clock), counts_(counts) {
  if (options.threads <= 1) own_ = make_prover(question, variety, options, clock);
}

LeafProofs::~LeafProofs() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  handed_over_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void LeafProofs::add(Lines& lines, Leaf leaf) {
  if (!filling_) filling_ = std::make_unique<Batch>();
  filling_->leaves.push_back(std::move(leaf));
  if (filling_->leaves.size() == kLeavesOfBatch) hand_over(lines);
}

Shown LeafProofs::finish(Lines& lines) {
  if (filling_) hand_over(lines);
  merge_done(lines, 0);
  batches_ = 0;
  return std::exchange(shown_, {});
}

void LeafProofs::prove(Prover& prover, Batch& batch) try {
  prover.begin(batch.looks_for_points);
  for (const Leaf& leaf : batch.leaves) {
    const std::uint64_t before = prover.boxes();
    prover.prove(leaf);
    batch.boxes.push_back(prover.boxes() - before);
  }
  batch.shown.has_met_variety = prover.has_met_variety();
  batch.shown.has_met_point = prover.has_met_point();
  batch.shown.sign = prover.sign();
} catch (const Rejection& why) {
  batch.failure = {true, why.what()};
} catch (const Unfinished& why) {
  batch.failure = {false, why.what()};
} catch (...) {
  batch.fault = std::current_exception();
}

void LeafProofs::hand_over(Lines& lines) {
  std::unique_ptr<Batch> batch = std::exchange(filling_, nullptr);
  batch->looks_for_points = batches_++ < kBatchesForPoints;
  if (own_) {
    prove(*own_, *batch);
    return merge(lines, *batch);
  }
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(batch));
  }
  if (threads_.size() < options_.threads) start_thread();
  handed_over_.notify_one();
  merge_done(lines, kBatchesAhead * options_.threads);
}

/// Takes results from the front until at most so many batches are left.
void LeafProofs::merge_done(Lines& lines, std::size_t most_left) {
  for (;;) {
    std::unique_ptr<Batch> batch;
    {
      std::unique_lock lock(mutex_);
      const auto is_done = [this] { return waiting_.empty() || waiting_.front()->is_done; };
      if (waiting_.size() <= most_left && !(is_done() && !waiting_.empty())) return;
      if (done_.wait_for(lock, kBetweenTicks, is_done) && !waiting_.empty()) {
        batch = std::move(waiting_.front());
        waiting_.pop_front();
        --taken_;
      }
    }
    if (batch) merge(lines, *batch);
    clock_.tick();
  }
}

void LeafProofs::merge(Lines& lines, const Batch& batch) {
  if (batch.fault) std::rethrow_exception(batch.fault);
  for (std::size_t i = 0; i < batch.leaves.size(); ++i) {
    const Leaf& leaf = batch.leaves[i];
    lines.name_line(leaf.line);
    const std::string here = leaf.name + ": ";
    ++counts_.leaves, ++shown_.leaves;
    if (question_.paves) ++counts_.paved[static_cast<std::size_t>(leaf.claim)];
    if (i == batch.boxes.size() && batch.failure->is_rejection)
      throw Rejection(here + batch.failure->why);
    if (i == batch.boxes.size()) throw Unfinished(here + batch.failure->why);
    counts_.boxes += batch.boxes[i], shown_.boxes += batch.boxes[i];
    if (counts_.boxes > options_.max_boxes)
      throw Unfinished(here + "the leaves up to this one need more than " +
                       std::to_string(options_.max_boxes) + " boxes");
  }
  if (shown_.sign * batch.shown.sign < 0)
    throw Rejection(batch.leaves.back().name + ": " + kOppositeSigns);
  if (shown_.sign == 0) shown_.sign = batch.shown.sign;
  shown_.has_met_variety |= batch.shown.has_met_variety;
  shown_.has_met_point |= batch.shown.has_met_point;
  lines.name_line(0);
}

/// If the system gives no more threads, those that run do the work.
void LeafProofs::start_thread() try {
  threads_.emplace_back([this] { work(); });
} catch (const std::system_error&) {
  if (threads_.empty()) throw std::bad_alloc();
}

LeafProofs::Batch* LeafProofs::take_batch() {
  std::unique_lock lock(mutex_);
  handed_over_.wait(lock, [this] { return stop_ || taken_ < waiting_.size(); });
  return stop_ ? nullptr : waiting_[taken_++].get();
}

/// Each thread has a question of its own, since proving adds derivatives to it.
void LeafProofs::work() noexcept {
  const UsualEnvironment environment;
  {
    WorkClock clock(clock_, stop_);
    std::optional<Question> question;
    std::unique_ptr<Prover> prover;
    while (Batch* batch = take_batch()) {
      try {
        if (!question) question.emplace(question_);
        if (!prover) prover = make_prover(*question, variety_, options_, clock);
        prove(*prover, *batch);
      } catch (...) {
        batch->fault = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      batch->is_done = true;
      done_.notify_one();
    }
  }
  flint_cleanup();
}

}  // namespace regulus::verifier
