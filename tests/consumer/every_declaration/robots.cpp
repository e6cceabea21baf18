// SPDX-License-Identifier: GPL-3.0-or-later
// Calls every function of a robot in C++.
#include <cstdio>
#include <regulus/regulus.hpp>

void use_robots() {
  regulus::Robot robot("circle");
  robot.source("a test");
  const GiNaC::symbol y("y"), k("k"), e("e"), t("t");
  const regulus::Formula x = robot.pose("x", "m");
  robot.pose(y, "m");
  const regulus::Formula one = robot.constant("one", 1);
  robot.constant(k, 0);
  const regulus::Formula h = robot.uncertain("h", 1, 0, "size");
  robot.uncertain(e, 0, 0, "size");
  const std::vector<regulus::Formula> a = robot.point("a", {0, 0}), b = robot.ball("b", {0, 0}, 0);
  const regulus::Formula left = robot.let("left", x - h + k + e + a[0] + b[0]);
  robot.matrix({{left, y}, {-regulus::Formula(y), x + h}});
  robot.row_scale({one, one});
  robot.motion("across").range(x, 2, 3).range(y, 2, 3).error(x, "0.01").constraint(x - 4).alpha(0);
  auto& along = robot.motion("along");
  const regulus::Formula s = along.parameter("s", 2, 3);
  const regulus::Formula u = along.parameter(t, 2, 3);
  along.pose(x, s).pose(y, u);

  regulus::Robot other("of a matrix");
  const GiNaC::symbol z("z");
  other.pose(z, "m");
  other.matrix(GiNaC::matrix{{z}});
  other.motion("right").range(z, 1, 2);

  std::printf("%zu %zu %d\n", robot.model().motions.size(), other.model().motions.size(),
              robot.model_file().empty());
  const regulus::Question question(robot, "across");
  std::puts(regulus::name(regulus::check(question).verdict));
}
