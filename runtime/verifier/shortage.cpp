// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/shortage.hpp"

#include <cmath>

#include "runtime/verifier/evaluation.hpp"

namespace regulus::verifier {

std::optional<Ball> need_along(const Question& q, const std::vector<double>& y, long bits) {
  const LoadLines& load = *q.load;
  const auto middle = evaluate(q.graph, load.middle, {}, bits);
  const auto spread = evaluate(q.graph, load.spread, {}, bits);
  if (!middle || !spread) return std::nullopt;
  Ball sum;
  for (std::size_t j = 0; j < y.size(); ++j) {
    arb_addmul(sum.get(), Ball(point(y[j]), bits).get(), (*middle)[j].get(), bits);
    arb_addmul(sum.get(), Ball(point(std::fabs(y[j])), bits).get(), (*spread)[j].get(), bits);
  }
  for (const WrenchBall& ball : load.balls) {
    const auto radius = evaluate(q.graph, {ball.radius}, {}, bits);
    if (!radius) return std::nullopt;
    Ball length;
    for (const std::size_t j : ball.members) {
      const Ball part(point(y[j]), bits);
      arb_addmul(length.get(), part.get(), part.get(), bits);
    }
    arb_sqrtpos(length.get(), length.get(), bits);
    arb_addmul(sum.get(), (*radius)[0].get(), length.get(), bits);
  }
  return sum;
}

std::optional<Ball> gift_along(const Question& q, const std::vector<Ball>& A,
                               const std::vector<double>& y, long bits) {
  const auto least = evaluate(q.graph, q.load->least, {}, bits);
  const auto largest = evaluate(q.graph, q.load->largest, {}, bits);
  if (!least || !largest) return std::nullopt;
  Ball sum;
  for (std::size_t i = 0; i < q.rows; ++i) {
    Ball along, low, high;
    for (std::size_t j = 0; j < y.size(); ++j)
      arb_addmul(along.get(), A[i * q.columns + j].get(), Ball(point(y[j]), bits).get(), bits);
    arb_mul(low.get(), along.get(), (*least)[i].get(), bits);
    arb_mul(high.get(), along.get(), (*largest)[i].get(), bits);
    arb_max(low.get(), low.get(), high.get(), bits);
    arb_add(sum.get(), sum.get(), low.get(), bits);
  }
  return sum;
}

}  // namespace regulus::verifier
