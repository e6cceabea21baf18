// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <exception>

#include "codegen/answer/services.hpp"
#include "runtime/problem/observer.hpp"
#include "runtime/search/leaf_claims.hpp"

namespace regulus::detail {

/// Passes the boxes of a paving to Services::on_box, and ends the search when that throws, when a
/// line cannot be written, or when the run is interrupted.
class BoxListener final : public Observer {
 public:
  /// `services` and the kernel of `problem` must outlive this; `reach` as for LeafClaims.
  BoxListener(const Services& services, const Problem& problem, std::size_t reach)
      : services_(services), claims_(problem, reach) {}

  void on_leaf(const OpenBox& box, Rule rule, const Proof&) noexcept override {
    if (services_.on_box) tell(claims_.of(box.box, rule), box.box);
  }
  void on_open(const OpenBox& box) noexcept override { tell(Claim::kUndecided, box.box); }
  void on_progress(const Statistics&, std::uint64_t) noexcept override {
    if (services_.interrupt != nullptr && *services_.interrupt) stop_ = true;
  }

  void ask_for_end() noexcept { stop_ = true; }
  [[nodiscard]] const std::atomic<bool>& stop() const noexcept { return stop_; }
  /// Throws what the listener has thrown.
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  void tell(Claim claim, std::span<const Interval> box) noexcept {
    if (!services_.on_box || thrown_) return;
    try {
      services_.on_box(claim, box);
    } catch (...) {
      thrown_ = std::current_exception();
      stop_ = true;
    }
  }

  const Services& services_;
  LeafClaims claims_;
  std::atomic<bool> stop_{false};
  std::exception_ptr thrown_;
};

}  // namespace regulus::detail
