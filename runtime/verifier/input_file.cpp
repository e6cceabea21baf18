// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace regulus::verifier {
namespace {

constexpr std::size_t kPart = 1 << 16;

ssize_t read_some(int descriptor, std::vector<char>& buffer) {
  ssize_t count;
  do {
    count = ::read(descriptor, buffer.data(), buffer.size());
  } while (count < 0 && errno == EINTR);
  return count;
}

}  // namespace

/// With O_NONBLOCK a pipe opens at once. If it has no writer, its end is visible at once.
InputFile::InputFile(const std::string& path)
    : path_(path),
      descriptor_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)),
      buffer_(kPart) {
  setg(buffer_.data(), buffer_.data(), buffer_.data());
  if (descriptor_ < 0) fail(std::strerror(errno));
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) fail(std::strerror(errno));
  if (S_ISDIR(status.st_mode)) fail("it is a directory");
  // From here on, reading waits for the bytes that a writer still sends.
  if (::fcntl(descriptor_, F_SETFL, 0) != 0) fail(std::strerror(errno));
  if (S_ISFIFO(status.st_mode) && underflow() == traits_type::eof())
    fail("it is a pipe, and nobody writes to it");
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void InputFile::fail(const std::string& why) {
  if (descriptor_ >= 0) ::close(descriptor_);
  throw std::runtime_error("cannot read " + path_ + ": " + why);
}

InputFile::int_type InputFile::underflow() {
  if (gptr() < egptr()) return traits_type::to_int_type(*gptr());
  const ssize_t count = read_some(descriptor_, buffer_);
  if (count < 0) throw std::runtime_error(std::strerror(errno));
  setg(buffer_.data(), buffer_.data(), buffer_.data() + count);
  return count > 0 ? traits_type::to_int_type(buffer_.front()) : traits_type::eof();
}

std::string read_text(const std::string& path, std::size_t most) {
  InputFile file(path);
  std::string text;
  for (int c; (c = file.sbumpc()) != std::char_traits<char>::eof();) {
    if (text.size() == most)
      throw std::runtime_error("cannot read " + path + ": it has more than " +
                               std::to_string(most) + " bytes");
    text.push_back(char(c));
  }
  return text;
}

}  // namespace regulus::verifier
