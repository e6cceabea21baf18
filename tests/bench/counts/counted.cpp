// SPDX-License-Identifier: GPL-3.0-or-later
// The program that callgrind runs; callgrind counts inside bench_counted_region only.
//
//     bench_counted kernel ISA     K·M of the sample, by the kernel compiled ahead of time
//     bench_counted rival KEY      the same by a rival
//     bench_counted search         one whole search with a portable kernel; prints its boxes
#include <functional>
#include <iostream>
#include <stdexcept>
#include <string>

#include "runtime/search/solver.hpp"
#include "tests/bench/kernel/ahead_of_time.hpp"
#include "tests/bench/kernel/batched.hpp"
#include "tests/bench/kernel/rival.hpp"

extern "C" {
extern const regulus_kernel bench_search_kernel;
[[gnu::noinline]] void bench_counted_region(const std::function<void()>& work) { work(); }
}

namespace regulus::detail::bench {
namespace {

void count_kernel(const std::string& isa) {
  const regulus_kernel* kernel = ahead_of_time(parse_isa(isa).value());
  if (!kernel) throw std::runtime_error("there is no kernel for " + isa);
  const Sample sample = make_sample(kernel_subject());
  BatchedProduct product(*kernel, sample);
  bench_counted_region([&] { product.pass(); });
}

void count_rival(const std::string& key) {
  const Sample sample = make_sample(kernel_subject());
  for (const NamedRival& rival : make_rivals(sample))
    if (rival.key == key && rival.rival) {
      bench_counted_region([&] { rival.rival->pass(); });
      return;
    }
  throw std::runtime_error("there is no rival " + key);
}

void count_search() {
  const Variety variety = search_subject().variety;
  Problem problem;
  problem.kernel = &bench_search_kernel;
  problem.outer = variety.outer;
  problem.inner = variety.inner;
  problem.alpha = variety.alpha;
  Result result;
  bench_counted_region([&] { result = solve(problem, Settings{}); });
  if (result.verdict != Verdict::kNoSingularity) throw std::runtime_error("no proof");
  std::cout << "boxes: " << result.statistics.boxes << '\n';
}

}  // namespace
}  // namespace regulus::detail::bench

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "", which = argc > 2 ? argv[2] : "";
  try {
    if (what == "kernel")
      regulus::detail::bench::count_kernel(which);
    else if (what == "rival")
      regulus::detail::bench::count_rival(which);
    else if (what == "search")
      regulus::detail::bench::count_search();
    else
      return 64;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 70;
  }
}
