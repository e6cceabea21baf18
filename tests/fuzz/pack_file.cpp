// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes, read to the end, are a pack program or are refused. A program that is read can run.
#include "runtime/machine/pack_file.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "runtime/kernel/buffers.hpp"
#include "runtime/kernel/call.hpp"
#include "runtime/machine/machine_kernel.hpp"

namespace {

using namespace regulus;
using namespace regulus::detail;

/// Larger programs are read but not run: their outputs alone would take gigabytes.
constexpr std::uint32_t kMaxOutputsToRun = 1U << 14;

std::uint32_t most_outputs(const machine::PackKernel& program) {
  std::uint32_t most = 0;
  for (const machine::PackFunction& function : program.functions)
    most = std::max(most, function.outputs);
  return most;
}

/// Runs every function that the kernel names, on boxes, some of which contain 0.
void run(const machine::PackKernel& program, Isa isa) {
  const machine::MachineKernel machine(program, isa);
  const CheckedKernel kernel(*machine.get());
  BoxBatch boxes(program.variables);
  for (std::size_t k = 0; k < program.variables; ++k)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      boxes.set(k, lane, {static_cast<double>(lane) - 4.0, static_cast<double>(k + lane)});
  PointRows points(std::size_t{program.rows} * program.columns);
  for (std::size_t e = 0; e < points.size(); ++e) points.set_all_lanes(e, 0.5);
  OutputBatch out(most_outputs(program));
  for (const KernelFunctionRow& row : kKernelFunctions)
    if (row.field != nullptr)
      static_cast<void>(
          kernel.call(kernel.functions().*row.field, boxes.data(), points.data(), out.data()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto program = machine::read_pack_kernel(bytes);
  if (!program) return 0;
  if (machine::to_bytes(*program) != bytes) std::abort();
  if (most_outputs(*program) > kMaxOutputsToRun) return 0;
  run(*program, Isa::kPortable);
  if (supported(Isa::kAvx2)) run(*program, Isa::kAvx2);
  return 0;
}
