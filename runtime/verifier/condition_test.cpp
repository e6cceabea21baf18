// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/condition_test.hpp"

#include "runtime/verifier/singular_claims.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfBound = 128;
constexpr long kBitsOfContradiction = 128;

}  // namespace

ConditionTest::ConditionTest(Question& question, const Variety& variety)
    : q_(question),
      variety_(variety),
      m_(question.rows),
      n_(question.columns),
      slopes_(question),
      terms_(question),
      outside_(question, variety),
      defined_(question, join({&question.matrix, &question.defined, &question.motion_defined})),
      at_middle_(question, question.matrix) {
  const auto bound = evaluate(q_.graph, {q_.quantity->bound}, {}, kBitsOfBound);
  if (!bound) throw Unfinished("the bound has no certain value");
  bound_ = (*bound)[0].enclosure();
}

BoxAnswer ConditionTest::decide(const Box& box) {
  impact_.assign(box.size(), 0.0);
  place_middle(variety_, box, middle_);
  if (outside_.covers(box)) return BoxAnswer::kOutside;
  if (!defined_.run(box)) return BoxAnswer::kOpen;
  const bool has_middle = at_middle_.run(middle_.point);
  std::vector<double> A;
  for (const NodeId entry : q_.matrix)
    A.push_back(mid(has_middle ? at_middle_.value(entry) : defined_.value(entry)));
  const SingularBases bases = approx_singular_bases(std::move(A), m_, n_);
  if (bases.U.empty()) return BoxAnswer::kOpen;
  const std::optional<RotatedMatrix> B = rotated(box, bases);
  if (!B) return BoxAnswer::kOpen;
  std::vector<double> parts;
  if (keeps_singular_claim(SingularClaim::kRatioBelow, *B, bases, m_, n_, bound_, parts))
    return BoxAnswer::kProved;
  for (std::size_t k = 0; k < parts.size(); ++k) impact_[B->variable[k]] = parts[k];
  return BoxAnswer::kOpen;
}

std::optional<RotatedMatrix> ConditionTest::rotated(const Box& box, const SingularBases& bases) {
  if (auto B = terms_.rotate(box, middle_, bases)) return B;
  if (!slopes_.run(box, middle_)) return std::nullopt;
  return rotate(slopes_, bases, m_, n_);
}

bool ConditionTest::exceeds_at(const Box& point) const {
  std::vector<Ball> x;
  for (const Interval coordinate : point) x.emplace_back(coordinate, kBitsOfContradiction);
  const auto A = evaluate(q_.graph, q_.matrix, x, kBitsOfContradiction);
  return A && has_ratio(q_, *A, kBitsOfContradiction);
}

}  // namespace regulus::verifier
