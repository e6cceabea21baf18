// SPDX-License-Identifier: GPL-3.0-or-later
// Arms with joints that follow others.
#include "tests/property/import/chains.hpp"

namespace regulus::detail::test {
namespace {

TEST(RandomChains, HaveTheirTwistsAsModelFiles) {
  expect_chains(1000, 50, true, &RandomChain::toml);
}

TEST(RandomChains, HaveTheirTwistsAsUrdf) { expect_chains(2000, 25, false, &RandomChain::urdf); }

TEST(RandomChains, HaveTheirTwistsAsMjcf) { expect_chains(3000, 20, false, &RandomChain::mjcf); }

TEST(RandomChains, HaveTheirTwistsAsSdf) { expect_chains(4000, 25, false, &RandomChain::sdf); }

}  // namespace
}  // namespace regulus::detail::test
