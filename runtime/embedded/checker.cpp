// SPDX-License-Identifier: Apache-2.0
#include "runtime/embedded/checker.hpp"

#include "runtime/embedded/piece_search.hpp"

namespace regulus {

using namespace detail;

Checker::Checker(const regulus_kernel& kernel, std::span<const Interval> ranges, unsigned max_boxes,
                 double alpha)
    : search_(std::make_unique<PieceSearch>(kernel, ranges, max_boxes, alpha)) {}
Checker::Checker(Checker&&) noexcept = default;
Checker& Checker::operator=(Checker&&) noexcept = default;
Checker::~Checker() = default;

Check Checker::check(std::span<const Interval> piece) noexcept { return search_->check(piece); }

const regulus_kernel& Checker::kernel() const noexcept { return search_->kernel(); }

}  // namespace regulus
