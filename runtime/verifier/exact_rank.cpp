// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/exact_rank.hpp"

#include <algorithm>

#include "runtime/verifier/linear_algebra.hpp"

namespace regulus::verifier {
namespace {

// FORMAT.md, "Limits", documents these.
constexpr std::size_t kMostMinors = 4;
constexpr long kMostBits = 1024;  ///< to find the rows of a minor

std::vector<NodeId> rows_of(const Question& q, const std::vector<std::size_t>& rows) {
  std::vector<NodeId> result;
  for (const std::size_t row : rows) {
    const auto first = q.matrix.begin() + std::ptrdiff_t(row * q.columns);
    result.insert(result.end(), first, first + std::ptrdiff_t(q.columns));
  }
  return result;
}

}  // namespace

std::vector<NodeId> gram_matrix(Question& q) {
  std::vector<NodeId> result;
  for (std::size_t i = 0; i < q.columns; ++i)
    for (std::size_t j = 0; j < q.columns; ++j) {
      NodeId sum = kNoNode;
      for (std::size_t row = 0; row < q.rows; ++row) {
        const NodeId a = q.matrix[row * q.columns + i], b = q.matrix[row * q.columns + j];
        const NodeId product = q.graph.add(Op::kMultiply, std::min(a, b), std::max(a, b));
        sum = sum == kNoNode ? product : q.graph.add(Op::kAdd, sum, product);
      }
      result.push_back(sum);
    }
  return result;
}

bool ExactRank::is_full(const Box& box, const Box& middle) {
  ExactDeterminant* const minor = minor_at(middle);
  if (minor != nullptr && minor->exceeds_threshold(box)) return true;
  return gram().exceeds_threshold(box);
}

/// Returns the minor that elimination finds at a point; nullptr if it finds none, or one too many.
ExactDeterminant* ExactRank::minor_at(const Box& middle) {
  Rows rows;
  for (long bits = 64; bits <= kMostBits && rows.size() < q_.columns; bits *= 2) {
    std::vector<Ball> x;
    for (const Interval coordinate : middle) x.emplace_back(coordinate, bits);
    auto values = evaluate(q_.graph, q_.matrix, x, bits);
    if (values) rows = independent_rows(std::move(*values), q_.rows, q_.columns, bits);
  }
  if (rows.size() < q_.columns) return nullptr;
  std::sort(rows.begin(), rows.end());
  const auto known = minors_.find(rows);
  if (known != minors_.end()) return &known->second;
  if (minors_.size() == kMostMinors) return nullptr;
  return &minors_.try_emplace(rows, q_, variety_, rows_of(q_, rows), max_bits_).first->second;
}

/// Returns det AᵀA, which is the sum of the squares of all minors.
ExactDeterminant& ExactRank::gram() {
  if (!gram_) gram_.emplace(q_, variety_, gram_matrix(q_), max_bits_);
  return *gram_;
}

}  // namespace regulus::verifier
