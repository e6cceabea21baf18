// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/shortage.hpp"

#include "runtime/verifier/ball_matrix.hpp"
#include "runtime/verifier/evaluation.hpp"

namespace regulus::verifier {

namespace {

std::vector<std::size_t> free_rows(const Question& q) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < q.rows; ++i)
    if (q.load->least[i] == kNoNode) rows.push_back(i);
  return rows;
}

}  // namespace

/// y − Fᵀz with FFᵀz = Fy.
std::optional<std::vector<Ball>> without_free_forces(const Question& q, const std::vector<Ball>& A,
                                                     const std::vector<double>& y, long bits) {
  std::vector<Ball> result;
  for (const double one : y) result.emplace_back(point(one), bits);
  const std::vector<std::size_t> rows = free_rows(q);
  if (rows.empty()) return result;
  const std::size_t k = rows.size(), n = q.columns;
  BallMatrix F(k, n), transposed(n, k), square(k, k), power(k, 1), z(k, 1), Y(n, 1), change(n, 1);
  for (std::size_t j = 0; j < n; ++j) {
    arb_set(Y.at(j, 0), result[j].get());
    for (std::size_t f = 0; f < k; ++f) arb_set(F.at(f, j), A[rows[f] * n + j].get());
  }
  arb_mat_transpose(transposed.get(), F.get());
  arb_mat_mul(square.get(), F.get(), transposed.get(), bits);
  arb_mat_mul(power.get(), F.get(), Y.get(), bits);
  if (arb_mat_solve(z.get(), square.get(), power.get(), bits) == 0) return std::nullopt;
  arb_mat_mul(change.get(), transposed.get(), z.get(), bits);
  for (std::size_t j = 0; j < n; ++j)
    arb_sub(result[j].get(), result[j].get(), change.at(j, 0), bits);
  return result;
}

std::optional<Ball> need_along(const Question& q, const std::vector<Ball>& y, long bits) {
  const LoadLines& load = *q.load;
  const auto middle = evaluate(q.graph, load.middle, {}, bits);
  const auto spread = evaluate(q.graph, load.spread, {}, bits);
  if (!middle || !spread) return std::nullopt;
  Ball sum;
  for (std::size_t j = 0; j < y.size(); ++j) {
    Ball size;
    arb_abs(size.get(), y[j].get());
    arb_addmul(sum.get(), y[j].get(), (*middle)[j].get(), bits);
    arb_addmul(sum.get(), size.get(), (*spread)[j].get(), bits);
  }
  for (const WrenchBall& ball : load.balls) {
    const auto radius = evaluate(q.graph, {ball.radius}, {}, bits);
    if (!radius) return std::nullopt;
    Ball length;
    for (const std::size_t j : ball.members) {
      Ball square;
      arb_sqr(square.get(), y[j].get(), bits);
      arb_add(length.get(), length.get(), square.get(), bits);
    }
    arb_sqrtpos(length.get(), length.get(), bits);
    arb_addmul(sum.get(), (*radius)[0].get(), length.get(), bits);
  }
  return sum;
}

std::optional<Ball> gift_along(const Question& q, const std::vector<Ball>& A,
                               const std::vector<Ball>& y, long bits) {
  Ball sum;
  for (std::size_t i = 0; i < q.rows; ++i) {
    if (q.load->least[i] == kNoNode) continue;
    const auto limits = evaluate(q.graph, {q.load->least[i], q.load->largest[i]}, {}, bits);
    if (!limits) return std::nullopt;
    Ball along, low, high;
    for (std::size_t j = 0; j < y.size(); ++j)
      arb_addmul(along.get(), A[i * q.columns + j].get(), y[j].get(), bits);
    arb_mul(low.get(), along.get(), (*limits)[0].get(), bits);
    arb_mul(high.get(), along.get(), (*limits)[1].get(), bits);
    arb_max(low.get(), low.get(), high.get(), bits);
    arb_add(sum.get(), sum.get(), low.get(), bits);
  }
  return sum;
}

}  // namespace regulus::verifier
