// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <utility>
#include <vector>

#include "runtime/problem/observer.hpp"

namespace regulus::detail {

/// Returns those that are not null.
[[nodiscard]] inline std::vector<Observer*> present(std::initializer_list<Observer*> observers) {
  std::vector<Observer*> result;
  for (Observer* observer : observers)
    if (observer != nullptr) result.push_back(observer);
  return result;
}

/// Calls several observers, in their order. It does not own them.
class Observers final : public Observer {
 public:
  explicit Observers(std::vector<Observer*> observers) : observers_(std::move(observers)) {}

  void on_start(const Problem& problem, const Settings& settings) noexcept override {
    for (Observer* o : observers_) o->on_start(problem, settings);
  }
  void on_split(const OpenBox& box, const Split& split) noexcept override {
    for (Observer* o : observers_) o->on_split(box, split);
  }
  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override {
    for (Observer* o : observers_) o->on_leaf(box, rule, proof);
  }
  void on_open(const OpenBox& box) noexcept override {
    for (Observer* o : observers_) o->on_open(box);
  }
  void on_progress(const Statistics& statistics, std::uint64_t frontier) noexcept override {
    for (Observer* o : observers_) o->on_progress(statistics, frontier);
  }
  [[nodiscard]] bool wants_pause() noexcept override {
    bool wanted = false;
    for (Observer* o : observers_) wanted = o->wants_pause() || wanted;
    return wanted;
  }
  void on_pause(const SearchState& state, const OpenBoxes& open) noexcept override {
    for (Observer* o : observers_) o->on_pause(state, open);
  }
  void on_finish(const Result& result) noexcept override {
    for (Observer* o : observers_) o->on_finish(result);
  }

 private:
  std::vector<Observer*> observers_;
};

}  // namespace regulus::detail
