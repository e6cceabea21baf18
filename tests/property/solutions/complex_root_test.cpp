// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/solutions/complex_root.hpp"

#include "tests/support/planted_complex_roots.hpp"

namespace regulus::detail::test {
namespace {

TEST(PlantedComplexRoots, AreNeverTakenForOthers) { expect_no_false_root(1, 10'000); }

/// (z² + 1)(z − 1)² = 0
class DoubleRoot final : public PolynomialSystem {
 public:
  [[nodiscard]] std::size_t size() const noexcept override { return 1; }
  void enclose(std::span<const Rectangle> z, std::span<Rectangle> values,
               std::span<Rectangle> derivatives) const override {
    const Rectangle one(1.0), two(2.0), pair = z[0] * z[0] + one, shifted = z[0] - one;
    values[0] = pair * shifted * shifted;
    derivatives[0] = two * z[0] * shifted * shifted + two * pair * shifted;
  }
};

TEST(ARoot, IsProvedWhereItIsSimpleAlone) {
  const DoubleRoot system;
  const auto certified = [&](Complex near) { return certify_root(system, std::array{near}); };
  EXPECT_FALSE(certified({1, 0}));
  EXPECT_FALSE(certified({1 + 1e-9, 1e-9}));
  const auto up = certified({1e-3, 1.001}), down = certified({1e-3, -1.001});
  ASSERT_TRUE(up && down);
  EXPECT_FALSE(up->is_real);
  EXPECT_TRUE(certain_disjoint(*up, *down));
  EXPECT_FALSE(certain_disjoint(*up, *up));
}

}  // namespace
}  // namespace regulus::detail::test
