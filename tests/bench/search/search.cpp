// SPDX-License-Identifier: GPL-3.0-or-later
// One problem, searched again and again in one process.
//
//     bench_search MODEL MOTION TOLERANCE ROUNDS
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "regulus/codegen/driver/pipeline.hpp"
#include "regulus/codegen/driver/settings.hpp"
#include "regulus/search/solver.hpp"

namespace {

double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Seconds of one processor cycle: a chain of multiplications, four cycles each.
double cycle() {
  constexpr int kSteps = 200'000;
  const double start = cpu_seconds();
  double x = 1.0;
  for (int i = 0; i < kSteps; ++i) {
    x *= 1.0000001;
    __asm__ volatile("" : "+x"(x));
  }
  return (cpu_seconds() - start) / (4.0 * kSteps);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace regulus;
  using namespace regulus::codegen;
  if (argc != 5) return 64;
  ModelOptions model;
  model.path = argv[1];
  model.motion = argv[2];
  model.tolerances = {std::string("base,platform=") + argv[3]};
  const Preparation preparation = prepare(model, {});
  const regulus_kernel& kernel = preparation.kernel->functions();
  if (const regulus_expansion* x = kernel.expansion)
    fmt::print("derivatives listed: first {}, second {}, row first {}, row second {}\n",
               x->first.count, x->second.count, x->row_first.count, x->row_second.count);
  double best = 1e9;
  std::vector<double> cycles;
  Result result;
  for (int round = 0; round < std::atoi(argv[4]); ++round) {
    const double before = cycle(), start = cpu_seconds();
    result = solve(preparation.problem(), settings_from({}));
    const double seconds = cpu_seconds() - start;
    best = std::min(best, seconds);
    cycles.push_back(seconds / (0.5 * (before + cycle())));
  }
  std::nth_element(cycles.begin(), cycles.begin() + cycles.size() / 2, cycles.end());
  const auto boxes = static_cast<double>(result.statistics.boxes);
  fmt::print("{} boxes, {:.0f} ns a box, {:.0f} cycles a box, {:.3f} ms\n", boxes,
             best * 1e9 / boxes, cycles[cycles.size() / 2] / boxes, best * 1e3);
}
