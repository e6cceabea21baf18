// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>

#include "regulus/codegen/driver/pipeline.hpp"
#include "regulus/search/solver.hpp"

int main() {
  const auto prepared = regulus::codegen::prepare({.path = "arm.toml", .motion = "regular"}, {});
  const regulus::Result result = regulus::solve(prepared.problem(), {});
  std::puts(regulus::name(result.verdict));
}
