// SPDX-License-Identifier: Apache-2.0
#include "runtime/files/atomic_stream.hpp"

#include <system_error>

namespace regulus::detail {
namespace {

constexpr std::size_t kPart = std::size_t{1} << 16;

}  // namespace

AtomicStream::Buffer::Buffer(const std::string& name) : file(name), part_(kPart) {
  setp(part_.data(), part_.data() + part_.size());
}

std::streambuf::int_type AtomicStream::Buffer::overflow(int_type next) {
  if (sync() != 0) return traits_type::eof();
  if (!traits_type::eq_int_type(next, traits_type::eof())) sputc(traits_type::to_char_type(next));
  return traits_type::not_eof(next);
}

int AtomicStream::Buffer::sync() try {
  if (failure) return -1;
  file.write({pbase(), static_cast<std::size_t>(pptr() - pbase())});
  setp(part_.data(), part_.data() + part_.size());
  return 0;
} catch (const std::system_error&) {
  failure = std::current_exception();
  return -1;
}

AtomicStream::AtomicStream(const std::string& name) : std::ostream(nullptr), buffer_(name) {
  rdbuf(&buffer_);
}

void AtomicStream::put_in_place() {
  flush();
  if (buffer_.failure) std::rethrow_exception(buffer_.failure);
  buffer_.file.put_in_place_durably();
}

}  // namespace regulus::detail
