// SPDX-License-Identifier: Apache-2.0
// A singular matrix B of a bound means that the quantity attains a value only where the matrix of
// the model is regular.
#include "runtime/verifier/bordered_matrix.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/regularity.hpp"
#include "runtime/verifier/work_clock.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kMostRegularPieces = 1 << 10;
constexpr double kShortestRegularPiece = 0x1p-40;

Box box_around(const Box& from, const Box& to, Interval part) {
  Box box(from.size());
  for (std::size_t k = 0; k < box.size(); ++k)
    box[k] = from[k].lo == to[k].lo && from[k].hi == to[k].hi ? from[k]
                                                              : from[k] + (to[k] - from[k]) * part;
  return box;
}

}  // namespace

void require_regular_model(const Question& question, const Variety& variety, const Box& from,
                           const Box& to, WorkClock& clock) {
  Question model = question;
  model.matrix = question.quantity->model_matrix;
  model.rows = question.quantity->model_rows;
  model.columns = question.quantity->model_columns;
  model.constraints.clear();
  model.balls.clear();
  RegularityTest test(model, variety);
  std::vector<Interval> waiting{{0.0, 1.0}};
  for (std::size_t pieces = 0; !waiting.empty(); ++pieces) {
    const Interval part = waiting.back();
    waiting.pop_back();
    clock.tick();
    if (test.decide(box_around(from, to, part)) == RegularityTest::Answer::kRegular) continue;
    if (pieces == kMostRegularPieces || part.hi - part.lo < kShortestRegularPiece)
      throw Unfinished(
          "the matrix of the model is not certainly regular at the points of the witness, so that "
          "the quantity may have no value there");
    waiting.push_back({mid(part), part.hi});
    waiting.push_back({part.lo, mid(part)});
  }
}

}  // namespace regulus::verifier
