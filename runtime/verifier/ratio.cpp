// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/ratio.hpp"

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/singular_bases.hpp"

namespace regulus::verifier {
namespace {

/// Encloses |Av|² and |v|² of a column v of V.
struct Image {
  Image(const std::vector<Ball>& A, const std::vector<double>& V, std::size_t columns,
        std::size_t column, long bits) {
    for (std::size_t first = 0; first < A.size(); first += columns) {
      Ball sum;
      for (std::size_t j = 0; j < columns; ++j)
        arb_addmul(sum.get(), A[first + j].get(), Ball(point(V[j * columns + column]), bits).get(),
                   bits);
      arb_addmul(image.get(), sum.get(), sum.get(), bits);
    }
    for (std::size_t j = 0; j < columns; ++j) {
      const Ball part(point(V[j * columns + column]), bits);
      arb_addmul(length.get(), part.get(), part.get(), bits);
    }
  }

  Ball image, length;
};

}  // namespace

bool has_ratio(const Question& q, const std::vector<Ball>& A, long bits) {
  std::vector<double> middle;
  for (const Ball& entry : A) middle.push_back(mid(entry.enclosure()));
  const std::vector<double> V = approx_singular_bases(std::move(middle), q.rows, q.columns).V;
  const auto bound = evaluate(q.graph, {q.quantity->bound}, {}, bits);
  if (V.empty() || !bound || arb_is_positive((*bound)[0].get()) == 0) return false;
  Image high(A, V, q.columns, 0, bits), low(A, V, q.columns, q.columns - 1, bits);
  // |Au|²|v|² ≥ N²|Av|²|u|²
  arb_mul(high.image.get(), high.image.get(), low.length.get(), bits);
  arb_mul(low.image.get(), low.image.get(), high.length.get(), bits);
  arb_mul(low.image.get(), low.image.get(), (*bound)[0].get(), bits);
  arb_mul(low.image.get(), low.image.get(), (*bound)[0].get(), bits);
  return arb_is_positive(low.length.get()) != 0 && arb_ge(high.image.get(), low.image.get()) != 0;
}

}  // namespace regulus::verifier
