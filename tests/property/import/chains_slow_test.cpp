// SPDX-License-Identifier: GPL-3.0-or-later
// Many arms with joints that follow others.
#include "tests/property/import/chains.hpp"

namespace regulus::detail::test {
namespace {

TEST(ManyRandomChains, HaveTheirTwistsAsModelFiles) {
  expect_chains(10000, 1000, true, &RandomChain::toml);
}

TEST(ManyRandomChains, HaveTheirTwistsAsUrdf) {
  expect_chains(20000, 250, false, &RandomChain::urdf);
}

TEST(ManyRandomChains, HaveTheirTwistsAsMjcf) {
  expect_chains(30000, 250, false, &RandomChain::mjcf);
}

TEST(ManyRandomChains, HaveTheirTwistsAsSdf) {
  expect_chains(40000, 250, false, &RandomChain::sdf);
}

}  // namespace
}  // namespace regulus::detail::test
