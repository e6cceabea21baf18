// SPDX-License-Identifier: Apache-2.0
// Numbers as bytes, for messages between processes of one build: the order of the bytes is the
// processor's own.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "runtime/interval/interval.hpp"

namespace regulus::detail::cluster {

/// A message does not have the form that its sender should have given it.
class MalformedMessage : public std::runtime_error {
 public:
  MalformedMessage() : std::runtime_error("a message of another process is damaged") {}
};

class ByteWriter {
 public:
  template <typename Number>
  requires std::is_trivially_copyable_v<Number>
  void put(const Number& number) {
    bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  /// Takes one byte for numbers below 128.
  void put_count(std::uint64_t n) {
    for (; n >= 0x80; n >>= 7) bytes_ += static_cast<char>(n | 0x80);
    bytes_ += static_cast<char>(n);
  }
  void put_text(std::string_view text) {
    put_count(text.size());
    bytes_ += text;
  }
  template <typename Number>
  void put_list(std::span<const Number> numbers) {
    put_count(numbers.size());
    if (!numbers.empty())
      bytes_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
  }
  /// Calls `put_one` for each item, after their number.
  template <typename List, typename Put>
  void put_each(const List& list, const Put& put_one) {
    put_count(list.size());
    for (const auto& one : list) put_one(one);
  }
  void append(std::string_view bytes) { bytes_ += bytes; }

  [[nodiscard]] const std::string& bytes() const noexcept { return bytes_; }
  [[nodiscard]] std::string take() noexcept { return std::move(bytes_); }
  void clear() noexcept { bytes_.clear(); }

 private:
  std::string bytes_;
};

/// Reads what a ByteWriter wrote, in the same order. Accepts any bytes; throws MalformedMessage if
/// they end too early.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) noexcept : rest_(bytes) {}

  template <typename Number>
  requires std::is_trivially_copyable_v<Number>
  [[nodiscard]] Number take() {
    Number number;
    std::memcpy(&number, take_bytes(sizeof number).data(), sizeof number);
    return number;
  }
  [[nodiscard]] std::uint64_t take_count() {
    std::uint64_t n = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const auto byte = take<unsigned char>();
      n |= std::uint64_t{byte & 0x7fU} << shift;
      if (byte < 0x80) return n;
    }
    throw MalformedMessage();
  }
  /// The result refers to the bytes.
  [[nodiscard]] std::string_view take_text() { return take_bytes(take_count()); }
  /// Calls `take_one` as often as put_each called its function.
  template <typename Take>
  void take_each(const Take& take_one) {
    for (std::uint64_t left = take_count(); left > 0; --left) take_one();
  }
  template <typename Number>
  [[nodiscard]] std::vector<Number> take_list() {
    const std::uint64_t count = take_count();
    if (count > rest_.size() / sizeof(Number)) throw MalformedMessage();
    std::vector<Number> numbers(count);
    const std::string_view bytes = take_bytes(count * sizeof(Number));
    if (count != 0) std::memcpy(static_cast<void*>(numbers.data()), bytes.data(), bytes.size());
    return numbers;
  }
  /// Takes a list that must have so many numbers.
  template <typename Number>
  [[nodiscard]] std::vector<Number> take_list_of(std::size_t count) {
    std::vector<Number> numbers = take_list<Number>();
    if (numbers.size() != count) throw MalformedMessage();
    return numbers;
  }
  /// Takes a bool.
  [[nodiscard]] bool take_flag() {
    const auto byte = take<unsigned char>();
    if (byte > 1) throw MalformedMessage();
    return byte == 1;
  }
  [[nodiscard]] bool at_end() const noexcept { return rest_.empty(); }
  [[nodiscard]] std::string_view rest() const noexcept { return rest_; }

 private:
  std::string_view take_bytes(std::uint64_t count) {
    if (count > rest_.size()) throw MalformedMessage();
    const std::string_view bytes = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return bytes;
  }

  std::string_view rest_;
};

}  // namespace regulus::detail::cluster
