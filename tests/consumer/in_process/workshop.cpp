// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <regulus/regulus.hpp>

int main() {
  const auto question = regulus::Question::of_file("arm.toml", "regular");
  const regulus::Finding finding = regulus::check(question);
  std::puts(regulus::name(finding.verdict));
}
