// SPDX-License-Identifier: GPL-3.0-or-later
// The text that a certificate writes for an expression means this expression: the verifier's own
// reader gives it the value that GiNaC gives the original.
#include "codegen/answer/certificate/certificate_expression_writer.hpp"

#include <gtest/gtest.h>

#include <random>

#include "runtime/verifier/evaluation.hpp"

namespace regulus::detail::test {
namespace {

using GiNaC::ex;

class RandomExpressions {
 public:
  explicit RandomExpressions(unsigned seed) : random_(seed) {}

  ex make(int depth) {
    if (depth == 0) return leaf();
    const auto operand = [&] { return make(depth - 1); };
    switch (pick(10)) {
      case 0:
        return operand() + operand();
      case 1:
        return operand() - operand() * leaf();
      case 2:
        return operand() * operand();
      case 3:
        return operand() / (operand() + 20);
      case 4:
        return leaf() * (1 / GiNaC::sqrt(leaf() + 11) + 1 / (GiNaC::Pi + leaf()));
      case 5:
        return GiNaC::pow(operand(), 1 + pick(3)) / GiNaC::pow(leaf() + 13, 1 + pick(2));
      case 6:
        return GiNaC::pow(GiNaC::pow(operand(), 2) + 1, GiNaC::numeric(1 - 2 * pick(2), 2));
      case 7:
        return GiNaC::sin(operand()) - GiNaC::cos(leaf());
      case 8:
        return GiNaC::pow(GiNaC::pow(operand(), 2) + 2, exponent());
      default:
        return -operand() * GiNaC::numeric(1 + pick(5), 1 + pick(7));
    }
  }

  std::vector<GiNaC::symbol> symbols{GiNaC::symbol("x"), GiNaC::symbol("y"), GiNaC::symbol("z")};

 private:
  int pick(int n) { return int(random_() % unsigned(n)); }
  /// Returns exponents for roots of roots, thirds, and roots of more levels than powers may have.
  GiNaC::numeric exponent() {
    static const std::vector<int> kDenominators{3, 4, 5, 6, 8, 12, 16, 64, 1 << 20};
    const int denominator = kDenominators[std::size_t(pick(int(kDenominators.size())))];
    return GiNaC::numeric(pick(9) - 4, denominator) + pick(2);
  }
  ex leaf() {
    if (pick(4) == 0) return GiNaC::numeric(1 + pick(9), 1 + pick(3));
    return symbols[std::size_t(pick(3))];
  }

  std::mt19937 random_;
};

TEST(AnExpressionInACertificate, MeansWhatTheModelsDoes) {
  RandomExpressions random(2007);
  const std::vector<GiNaC::numeric> values{GiNaC::numeric(3, 4), GiNaC::numeric(-5, 2),
                                           GiNaC::numeric(7, 3)};
  int compared = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const ex e = random.make(1 + trial % 4);
    verifier::Graph graph;
    verifier::Scope scope;
    std::vector<verifier::Ball> at;
    GiNaC::exmap point;
    for (std::size_t k = 0; k < values.size(); ++k) {
      scope.emplace(random.symbols[k].get_name(), graph.add(verifier::Op::kVariable, int(k)));
      point[random.symbols[k]] = values[k];
      at.emplace_back(verifier::Interval{}, 200);
      fmpq_t value;
      fmpq_init(value);
      fmpq_set_si(value, values[k].numer().to_long(), ulong(values[k].denom().to_long()));
      arb_set_fmpq(at.back().get(), value, 200);
      fmpq_clear(value);
    }
    const std::string text = expression_text(e);
    const auto written = verifier::evaluate(graph, {verifier::parse(text, scope, graph)}, at, 200);
    const ex meant = GiNaC::evalf(e.subs(point));
    if (!written || !GiNaC::is_a<GiNaC::numeric>(meant)) continue;
    const auto& number = GiNaC::ex_to<GiNaC::numeric>(meant);
    if (!number.is_real()) continue;
    ++compared;
    const double shown = (*written)[0].enclosure().lo, exact = number.to_double();
    EXPECT_NEAR(shown, exact, 1e-9 * (1 + std::abs(exact))) << e << "\n" << text;
  }
  EXPECT_GT(compared, 2500);
}

}  // namespace
}  // namespace regulus::detail::test
