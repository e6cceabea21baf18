// SPDX-License-Identifier: Apache-2.0
#include "runtime/machine/pack_file.hpp"

#include <cstring>

namespace regulus::detail::machine {
namespace {

constexpr std::string_view kMagic = "regulus pack program 1\n";

/// Writes numbers by 7 bits, the low ones first; all but the last byte have the high bit set.
class Writer {
 public:
  void add(std::uint32_t number) {
    for (; number >= 0x80; number >>= 7) bytes_ += static_cast<char>(number | 0x80);
    bytes_ += static_cast<char>(number);
  }
  void add(int number) { add(static_cast<std::uint32_t>(number)); }
  void add(const Interval& x) {
    char bytes[sizeof x];
    std::memcpy(bytes, &x, sizeof x);
    bytes_.append(bytes, sizeof bytes);
  }
  void add(const std::string& text) {
    add(static_cast<std::uint32_t>(text.size()));
    bytes_ += text;
  }
  void add(const PackInstruction& i) {
    bytes_ += static_cast<char>(i.operation);
    for (const std::uint32_t operand : {i.a, i.b, i.c}) add(operand);
  }
  void add(const regulus_derivative& d) {
    for (const std::uint32_t number : {d.row, d.column, d.first, d.second}) add(number);
  }
  template <class Item>
  void add(const std::vector<Item>& list) {
    add(static_cast<std::uint32_t>(list.size()));
    for (const Item& item : list) add(item);
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_{kMagic};
};

/// Reads the output of Writer. After bytes that Writer does not produce, every value is 0.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {
    sound_ = rest_.starts_with(kMagic);
    if (sound_) rest_.remove_prefix(kMagic.size());
  }

  [[nodiscard]] bool at_end() const noexcept { return sound_ && rest_.empty(); }

  std::uint32_t number() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
      const auto byte = static_cast<unsigned char>(this->byte());
      value |= std::uint64_t{byte & 0x7fu} << shift;
      if (byte >= 0x80) continue;
      // Each number has only one form: no zero byte at the end, and nothing beyond 32 bits.
      if (value > UINT32_MAX || (byte == 0 && shift > 0)) break;
      return static_cast<std::uint32_t>(value);
    }
    sound_ = false;
    return 0;
  }
  void read(std::uint32_t& number) { number = this->number(); }
  void read(int& number) { number = static_cast<int>(this->number()); }
  void read(Interval& x) {
    const std::string_view bytes = take(sizeof x);
    if (sound_) std::memcpy(static_cast<void*>(&x), bytes.data(), sizeof x);
  }
  void read(std::string& text) { text = take(number()); }
  void read(PackInstruction& i) {
    i.operation = static_cast<PackOperation>(byte());
    for (std::uint32_t* operand : {&i.a, &i.b, &i.c}) read(*operand);
  }
  /// Reads the number of a function in kKernelFunctions.
  void read(KernelFunction& function) {
    const std::uint32_t number = this->number();
    sound_ = sound_ && number < kKernelFunctions.size();
    function = static_cast<KernelFunction>(sound_ ? number : 0);
  }
  void read(regulus_derivative& d) {
    for (unsigned* number : {&d.row, &d.column, &d.first, &d.second}) read(*number);
  }
  /// Each item takes at least one byte, so the number of bytes bounds the allocation.
  template <class Item>
  void read(std::vector<Item>& list) {
    const std::uint32_t size = number();
    sound_ = sound_ && size <= rest_.size();
    if (sound_) list.resize(size);
    for (Item& item : list) read(item);
  }

 private:
  char byte() {
    const std::string_view bytes = take(1);
    return sound_ ? bytes.front() : '\0';
  }
  std::string_view take(std::size_t size) {
    sound_ = sound_ && size <= rest_.size();
    if (!sound_) return {};
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }

  std::string_view rest_;
  bool sound_;
};

template <class Kernel, class Use>
void for_each_size(Kernel& k, Use use) {
  for (auto* size :
       {&k.variables, &k.motion_variables, &k.rows, &k.columns, &k.constraints, &k.pose_parameters})
    use(*size);
}

void read(Reader& in, PackFunction& function) {
  in.read(function.code);
  in.read(function.part_ends);
  in.read(function.constants);
  in.read(function.slots);
  in.read(function.outputs);
}

void read(Reader& in, PackExpansion& x) {
  in.read(x.product);
  for (PackDerivatives& d : x.derivatives) {
    in.read(d.function);
    in.read(d.list);
  }
  in.read(x.row_of_variable);
  in.read(x.ball_of_variable);
  in.read(x.nominal);
}

}  // namespace

std::string to_bytes(const PackKernel& program) {
  Writer out;
  for_each_size(program, [&](std::uint32_t size) { out.add(size); });
  for (const PackFunction& function : program.functions) {
    out.add(function.code);
    out.add(function.part_ends);
    out.add(function.constants);
    out.add(function.slots);
    out.add(function.outputs);
  }
  out.add(std::uint32_t{program.has_expansion});
  const PackExpansion& x = program.expansion;
  out.add(static_cast<std::uint32_t>(x.product));
  for (const PackDerivatives& d : x.derivatives) {
    out.add(static_cast<std::uint32_t>(d.function));
    out.add(d.list);
  }
  out.add(x.row_of_variable);
  out.add(x.ball_of_variable);
  out.add(x.nominal);
  out.add(program.identity);
  return out.take();
}

std::optional<PackKernel> read_pack_kernel(std::string_view bytes) {
  Reader in(bytes);
  PackKernel program;
  for_each_size(program, [&](std::uint32_t& size) { in.read(size); });
  for (PackFunction& function : program.functions) read(in, function);
  const std::uint32_t has_expansion = in.number();
  program.has_expansion = has_expansion == 1;
  read(in, program.expansion);
  in.read(program.identity);
  if (!in.at_end() || has_expansion > 1) return std::nullopt;
  if (!find_fault(program).empty()) return std::nullopt;
  return program;
}

}  // namespace regulus::detail::machine
