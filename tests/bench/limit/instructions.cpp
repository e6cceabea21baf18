// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/limit/instructions.hpp"

#include <fstream>
#include <set>
#include <sstream>

#include "tests/bench/measure/process.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::bench {
namespace {

bool is_exact_double(const Program& program, NodeId id) {
  const Op op = program.nodes[id].op;
  return op == Op::kPoint || op == Op::kConstant;
}

bool starts_with_one_of(std::string_view text, std::initializer_list<std::string_view> heads) {
  for (const std::string_view head : heads)
    if (text.starts_with(head)) return true;
  return false;
}

void count(std::string_view instruction, VectorInstructions& counts) {
  const bool masked = instruction.find("{%k") != std::string_view::npos;
  if (starts_with_one_of(instruction, {"vadd", "vsub", "vmul", "vfm", "vfnm", "vmin", "vmax"}))
    ++counts.arithmetic;
  else if (starts_with_one_of(instruction, {"vmov", "vbroadcast"}) && !masked)
    ++counts.moves;
  else
    ++counts.selection;
}

}  // namespace

std::size_t sines_and_cosines(const Program& program) {
  std::set<NodeId> arguments;
  for (const Node& node : program.nodes)
    if (node.op == Op::kSin || node.op == Op::kCos) arguments.insert(node.a);
  return arguments.size();
}

std::size_t bound_operations(const Program& program) {
  constexpr std::size_t kSum = 2, kProductWithDouble = 2, kProduct = 6;
  std::size_t total = 0;
  for (const Node& node : program.nodes) {
    if (node.op == Op::kAdd || node.op == Op::kSubtract) total += kSum;
    if (node.op == Op::kMultiply)
      total += is_exact_double(program, node.a) || is_exact_double(program, node.b)
                   ? kProductWithDouble
                   : kProduct;
  }
  return total;
}

VectorInstructions count_instructions(std::string_view listing, std::string_view symbol) {
  constexpr int kHexadecimal = 16;
  VectorInstructions counts;
  bool inside = false;
  std::size_t start = 0, last = 0;
  std::istringstream lines{std::string(listing)};
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with(">:")) {  // "0000000000000110 <symbol>:"
      counts.bytes += last - start;
      start = last = std::stoul(line, nullptr, kHexadecimal);
      inside = line.find(symbol) != std::string::npos;
      continue;
    }
    // "  113:\tvaddpd %zmm1,%zmm2,%zmm3"
    const std::size_t tab = line.find('\t');
    if (!inside || tab == std::string::npos) continue;
    last = std::stoul(line, nullptr, kHexadecimal);
    if (line.find("%zmm") != std::string::npos)
      count(std::string_view(line).substr(tab + 1), counts);
  }
  counts.bytes += last - start;
  return counts;
}

std::optional<std::string> disassemble(const std::string& code) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.path() / "code";
  std::ofstream(path, std::ios::binary) << code;
  ProcessRun run = run_process(
      {"objdump", "-D", "-b", "binary", "-m", "i386:x86-64", "--no-show-raw-insn", path});
  if (run.exit_code != 0) return std::nullopt;
  return run.output.substr(0, run.output.find("\tret"));
}

}  // namespace regulus::detail::bench
