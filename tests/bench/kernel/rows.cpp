// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/kernel/rows.hpp"

#include <fmt/format.h>

#include <deque>
#include <map>

#include "codegen/kernel/jit/jit.hpp"
#include "codegen/kernel/pack/select.hpp"
#include "runtime/machine/machine_kernel.hpp"
#include "tests/bench/kernel/ahead_of_time.hpp"
#include "tests/bench/kernel/batched.hpp"
#include "tests/bench/kernel/rival.hpp"

namespace regulus::detail::bench {
namespace {

/// A contender, and the contents of its row besides the times.
struct Entry {
  Row row;
  Contender contender;
};

class KernelBench {
 public:
  KernelBench() {
    for (const Isa isa : kAllIsas) add_compiled_in_process(isa);
    for (const Isa isa : kAllIsas) add_compiled_ahead(isa);
    for (const Isa isa : kAllIsas) add_interpreted(isa);
    for (NamedRival& rival : rivals_) add_rival(rival);
  }

  Section run() {
    std::vector<Contender> contenders;
    for (const Entry& entry : entries_)
      if (entry.row.skipped.empty()) contenders.push_back(entry.contender);
    const std::vector<Timing> timings = compare(contenders);

    Section section = heading();
    auto timing = timings.begin();
    for (const Entry& entry : entries_) {
      Row& row = section.rows.emplace_back(entry.row);
      if (!row.skipped.empty()) continue;
      row.value = timing->seconds.median * 1e9;
      row.unit = "ns";
      row.ratio = timing->ratio;
      ++timing;
    }
    return section;
  }

 private:
  [[nodiscard]] Section heading() const {
    return {
        "kernel",
        "K·M of robot 1, one box",
        fmt::format(
            "Nanoseconds for the 36 entries of K·M from a box and a K, `models/robot_1.toml` over "
            "`wide_15`: one program of {} operations, sines and cosines included, for everyone. "
            "Boxes and K are those of a search; {} boxes, all in the first level cache. The ratio "
            "is to the first row.",
            left_product_of(module_).nodes.size(), Sample::kBoxes),
        {}};
  }

  void add(Row row, std::function<void()> pass) {
    Contender contender{row.name, static_cast<double>(Sample::kBoxes), std::move(pass)};
    entries_.push_back({std::move(row), std::move(contender)});
  }

  void add_kernel(std::string name, const regulus_kernel& kernel, std::string explanation) {
    BatchedProduct& product = products_.emplace_back(kernel, sample_);
    Row row;
    row.name = std::move(name);
    row.explanation = std::move(explanation);
    add(std::move(row), [&product] { product.pass(); });
  }

  void add_compiled_in_process(Isa isa) {
    const std::string title = fmt::format("ours, {}, in process", name(isa));
    const std::string explanation =
        "the emitted text, compiled in process as `check` does; eight boxes a call";
    if (!supported(isa)) {
      entries_.push_back({skipped_row(title, "this processor cannot run it", explanation), {}});
      return;
    }
    CompileOptions options;
    options.isa = isa;
    options.use_cache = false;
    const auto& compiled = compiled_.emplace_back(compile_kernel(select(module_), options));
    add_kernel(title, *compiled.kernel(), explanation);
  }

  void add_compiled_ahead(Isa isa) {
    const std::string title = fmt::format("ours, {}, ahead of time", name(isa));
    const std::string explanation = "the same text, compiled by the suite's own compiler at -O2";
    const regulus_kernel* kernel = ahead_of_time(isa);
    if (kernel && supported(isa))
      add_kernel(title, *kernel, explanation);
    else
      entries_.push_back({skipped_row(title, "this processor cannot run it", explanation), {}});
  }

  void add_interpreted(Isa isa) {
    const std::string title = fmt::format("ours, {}, interpreted", name(isa));
    const std::string explanation = "the list that the text is printed from, by the vector machine";
    if (!supported(isa)) {
      entries_.push_back({skipped_row(title, "this processor cannot run it", explanation), {}});
      return;
    }
    const auto& machine = machines_.emplace_back(select(module_), isa);
    add_kernel(title, *machine.get(), explanation);
  }

  void add_rival(NamedRival& rival) {
    if (!rival.rival) {
      entries_.push_back({skipped_row(rival.name, rival.absent, rival.explanation), {}});
      return;
    }
    Row row;
    row.name = rival.name;
    row.explanation = rival.explanation;
    if (rival.key == "boost_unprotected") row.target = ratio_at_least(20);
    add(std::move(row), [&rival] { rival.rival->pass(); });
  }

  Module module_ = kernel_subject();
  Sample sample_ = make_sample(module_);
  std::vector<NamedRival> rivals_ = make_rivals(sample_);
  std::deque<CompiledKernel> compiled_;
  std::deque<machine::MachineKernel> machines_;
  std::deque<BatchedProduct> products_;
  std::vector<Entry> entries_;
};

}  // namespace

Section kernel_rows() { return KernelBench().run(); }

}  // namespace regulus::detail::bench
