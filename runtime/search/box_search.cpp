// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/box_search.hpp"

#include <cmath>

namespace regulus::detail {
namespace {

/// Seconds between two saves: a tenth of the time so far, but at least this.
constexpr double kSoonestSave = 0.25;
/// Saving takes at most this part of the time.
constexpr double kPartForSaving = 0.05;

}  // namespace

std::optional<std::size_t> choose_variable(std::span<const Interval> box,
                                           std::span<const double> ranges,
                                           std::span<const double> impact, double least) {
  std::optional<std::size_t> best;
  double most = -1, most_width = 0;
  for (std::size_t v = 0; v < ranges.size(); ++v) {
    const double width = width_ru(box[v]) / ranges[v];
    if (!(width > least) || !bisect(box[v])) continue;
    const double weight = impact.empty() || std::isnan(impact[v]) ? width : impact[v];
    if (weight > most || (weight == most && width > most_width))
      best = v, most = weight, most_width = width;
  }
  return best;
}

double BoxCourse::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

std::chrono::steady_clock::time_point BoxCourse::deadline() const {
  const std::chrono::duration<double> limit(settings_.time_limit);
  if (!(limit < std::chrono::hours(24 * 365 * 100))) return Clock::time_point::max();
  return start_ + std::chrono::duration_cast<Clock::duration>(limit);
}

std::pair<TreeBox, TreeBox> BoxCourse::split(TreeBox parent, std::size_t variable,
                                             std::optional<double> at) {
  const Halves halves = at ? *cut(parent.box[variable], *at) : *bisect(parent.box[variable]);
  if (progress_ != nullptr)
    progress_->on_split({parent.id, parent.depth, parent.box},
                        {parent.id, std::uint32_t(variable), halves.left.hi, next_id_});
  if (settings_.save) tree_.add_split(parent.id, variable, at);
  TreeBox lower{next_id_, parent.depth + 1, parent.box};
  TreeBox upper{next_id_ + 1, parent.depth + 1, std::move(parent.box)};
  lower.box[variable] = halves.left;
  upper.box[variable] = halves.right;
  next_id_ += 2;
  return {std::move(lower), std::move(upper)};
}

void BoxCourse::leaf(const TreeBox& box, Rule rule, double bound) {
  if (settings_.save) tree_.add_leaf(box.id, bound);
  leave_open(box, rule);
}

void BoxCourse::leave_open(const TreeBox& box, Rule rule) {
  if (progress_ != nullptr) progress_->on_leaf({box.id, box.depth, box.box}, rule, {});
}

void BoxCourse::announce() {
  if (progress_ == nullptr) return;
  Settings settings;
  settings.time_limit = settings_.time_limit;
  settings.workers = settings_.workers;
  progress_->on_start(problem_, settings);
}

bool BoxCourse::stop(Reason reason) {
  stopped_by_ = reason;
  return true;
}

bool BoxCourse::must_stop() {
  if (is_out_of_memory_) return stop(Reason::kMemory);
  if (settings_.interrupt != nullptr && *settings_.interrupt) return stop(Reason::kInterrupted);
  if (boxes_ >= settings_.max_boxes) return stop(Reason::kBoxBudget);
  if (seconds() >= settings_.time_limit) return stop(Reason::kTimeBudget);
  return false;
}

bool BoxCourse::must_pause() {
  if (is_out_of_memory_) return stop(Reason::kMemory);
  if (settings_.interrupt != nullptr && *settings_.interrupt) return stop(Reason::kInterrupted);
  if (seconds() >= settings_.time_limit) return stop(Reason::kTimeBudget);
  return false;
}

Statistics BoxCourse::statistics() const {
  Statistics statistics;
  statistics.boxes = boxes_;
  statistics.seconds = seconds();
  return statistics;
}

void BoxCourse::tell_progress(std::size_t open) {
  if (progress_ != nullptr) progress_->on_progress(statistics(), open);
}

void BoxCourse::tell_end() {
  if (progress_ == nullptr) return;
  Result result;
  result.statistics = statistics();
  progress_->on_finish(result);
}

void BoxCourse::save_now_and_then(const Describe& describe) {
  const double now = seconds();
  const double pause = std::max(std::min(std::max(now / 10, kSoonestSave), settings_.save_every),
                                seconds_of_save_ / kPartForSaving);
  if (now - saved_ >= pause) save(describe);
}

void BoxCourse::save(const Describe& describe) {
  if (!settings_.save || is_out_of_memory_ || is_saved_last_) return;
  const double start = seconds();
  tree_.open.clear(), tree_.shown.clear(), tree_.own.clear();
  describe(tree_);
  settings_.save(tree_);
  saved_ = seconds();
  seconds_of_save_ = saved_ - start;
}

void BoxCourse::save_last(const Describe& describe) {
  save(describe);
  is_saved_last_ = true;
}

}  // namespace regulus::detail
