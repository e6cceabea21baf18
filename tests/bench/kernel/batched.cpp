// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/kernel/batched.hpp"

#include <stdexcept>

namespace regulus::detail::bench {

BatchedProduct::BatchedProduct(const regulus_kernel& kernel, const Sample& sample)
    : kernel_(kernel), out_(sample.outputs) {
  for (std::size_t first = 0; first < Sample::kBoxes; first += REGULUS_LANES) {
    BoxBatch& boxes = boxes_.emplace_back(sample.variables);
    PointRows& K = K_.emplace_back(sample.points);
    for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane) {
      for (std::size_t v = 0; v < sample.variables; ++v)
        boxes.set(v, lane, sample.boxes[(first + lane) * sample.variables + v]);
      for (std::size_t p = 0; p < sample.points; ++p)
        K.set(p, lane, sample.K[(first + lane) * sample.points + p]);
    }
  }
}

unsigned BatchedProduct::evaluate(std::size_t batch) noexcept {
  return kernel_.call_within_contract(kernel_.functions().left_product, boxes_[batch].data(),
                                      K_[batch].data(), out_.data());
}

void BatchedProduct::pass() noexcept {
  for (std::size_t batch = 0; batch < boxes_.size(); ++batch) evaluate(batch);
}

std::vector<Interval> BatchedProduct::entries(std::size_t box) {
  const std::size_t lane = box % REGULUS_LANES;
  if ((evaluate(box / REGULUS_LANES) >> lane) & 1)
    throw std::domain_error("an entry of K·M is undefined");
  std::vector<Interval> result;
  for (std::size_t e = 0; e < out_.size(); ++e) result.push_back(out_.get(e, lane));
  return result;
}

}  // namespace regulus::detail::bench
