// SPDX-License-Identifier: GPL-3.0-or-later
// Asks every question.
#include <cstdio>
#include <fstream>
#include <regulus/regulus.hpp>
#include <utility>

namespace {

using regulus::Question;

/// A bead on a rail between two pulleys. It is held where |x| ≤ 0.6.
constexpr const char* kBead = R"toml(regulus = 1
name = "bead"
[pose]
x = "m"
[geometry]
h = { value = 1, tolerance = 0, group = "size" }
[matrix]
twist = ["v_x"]
rows = [["x + h"], ["x - h"]]
[load.push]
force = [[-2, 2]]
[actuators]
force = [1, 9]
[motion.m]
x = [-0.5, 0.5]
)toml";

/// A point of a circle, by its first coordinate.
constexpr const char* kCircle = R"toml(regulus = 1
name = "circle"
[pose]
x = "m"
[closure]
unknowns = { y = "m" }
equations = ["x^2 + y^2 - 25"]
start = { x = 3, y = 4 }
range = { y = [-9, 9] }
[motion.point]
x = 3
)toml";

Question bead() { return Question::of_text(kBead, "bead", "m"); }

void change_questions() {
  std::ofstream("way.csv") << "t,x\n0,-0.5\n1,0.5\n";
  Question changed = bead(), moved = std::move(changed);
  changed = moved;
  changed = std::move(moved);
  changed.range("x", "0", "1/3")
      .tolerance("size", "0.01")
      .tube("x", "0.01")
      .alpha("0")
      .beyond_limits();
  std::puts(regulus::name(regulus::check(Question(changed)).verdict));
  std::puts(regulus::name(regulus::check(bead().waypoints("way.csv")).verdict));
}

void search() {
  regulus::LocateOptions paving;
  paving.resolution = "1/4";
  std::puts(regulus::name(regulus::locate(bead(), paving).verdict));
  const Question circle = Question::of_text(kCircle, "circle", "point");
  std::puts(regulus::solve(circle).headline.c_str());
  regulus::Places places;
  places.numbers.resize(1);
  std::puts(regulus::solve_many(circle, places).headline.c_str());
  std::puts(regulus::name(regulus::check_load(bead(), "push").verdict));
  regulus::LocateLoadOptions loads;
  loads.resolution = "1/4";
  std::puts(regulus::name(regulus::locate_load(bead(), loads).finding.verdict));
  regulus::MarginOptions growing;
  growing.scale = "1:2";
  growing.gap = "0.5";
  std::printf("%d\n", regulus::margin(bead(), growing).closed);
  regulus::BoundOptions most;
  most.quantity.quantity = "x";
  most.gap = "0.5";
  std::printf("%d\n", regulus::bound(bead(), most).closed);
}

void prepare() {
  regulus::PreparedQuestion first(bead()), prepared(std::move(first));
  first = std::move(prepared);
  regulus::Finding finding = first.check(bead());
  first.describe(bead(), finding);
  std::puts(regulus::name(finding.verdict));
  const std::vector<regulus::Interval> ranges(first.parameters().size(), {0.25, 0.5});
  std::puts(regulus::name(first.check(ranges).verdict));
  const Question arm = Question::of_file("arm.toml", "regular");
  regulus::Kernel made(arm, {.engine = regulus::Engine::kAuto}), kernel(std::move(made));
  made = std::move(kernel);
  regulus::Checker checker = made.checker(100);
  static_cast<void>(checker);
  std::printf("%zu %zu %zu\n", made.variables().size(), made.ranges().size(),
              made.motion_parameters());
}

void use_files() {
  static_cast<void>(regulus::check(bead(), {}, nullptr, "proof"));
  std::printf("%d\n", regulus::verify("proof").outcome == regulus::ProofOutcome::kVerified);
  std::printf("%d\n", regulus::describe_model(bead()).empty());
  std::ofstream("page.template") << "@REGULUS_TITLE@ @REGULUS_VERDICT@ @REGULUS_CLAIM@ "
                                    "@REGULUS_REPORT@ @REGULUS_SHA256@ @REGULUS_DATA@";
  regulus::PageContents contents;
  contents.json = regulus::check(bead()).json;
  contents.page_template = "page.template";
  regulus::write_page(bead(), contents, "page.html");
  std::printf("%d\n", regulus::robot_picture(bead()).empty());
  std::ofstream("none.urdf") << "<robot name='none'/>\n";
  try {
    static_cast<void>(regulus::import_file("none.urdf"));
  } catch (const regulus::InputError&) {
    std::puts("no robot");
  } catch (const regulus::UsageError&) {
    std::puts("no robot");
  }
}

}  // namespace

void use_questions() {
  change_questions();
  search();
  prepare();
  use_files();
}
