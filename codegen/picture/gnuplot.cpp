// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/picture/gnuplot.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <system_error>

#include "codegen/support/errors.hpp"

namespace regulus::inline picture {
namespace {

FileError system_error(const std::string& what, int error) {
  return FileError(what + ": " + std::strerror(error));
}

FileError cannot_start(const std::system_error& error) {
  if (error.code() != std::errc::no_such_file_or_directory)
    return FileError("cannot start gnuplot: " + error.code().message());
  return FileError(
      "gnuplot, which draws the pictures, was not found. On Debian: apt-get install gnuplot-nox");
}

}  // namespace

Gnuplot::Gnuplot(const std::string& picture) : picture_(picture) {
  constexpr int kWriting = O_WRONLY | O_CREAT | O_CLOEXEC;
  file_ = open(picture.c_str(), kWriting | O_EXCL, 0666);
  leaves_nothing_ = file_ >= 0;
  if (file_ < 0) file_ = open(picture.c_str(), kWriting, 0666);
  if (file_ < 0) throw system_error("cannot write " + picture, errno);
  std::array<int, 2> ends{-1, -1};
  drawing_ = memfd_create("gnuplot-drawing", MFD_CLOEXEC);
  errors_ = memfd_create("gnuplot-errors", MFD_CLOEXEC);
  const bool opened = drawing_ >= 0 && errors_ >= 0 &&
                      socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0;
  const int error = errno;
  input_ = ends[0];
  try {
    if (!opened) throw std::system_error(error, std::generic_category());
    process_.emplace(std::vector<std::string>{"gnuplot"},
                     StandardStreams{ends[1], drawing_, errors_});
  } catch (const std::system_error& failure) {
    if (ends[1] >= 0) close(ends[1]);
    close_all();
    throw cannot_start(failure);
  }
  close(ends[1]);
}

Gnuplot::~Gnuplot() {
  shutdown(input_, SHUT_WR);
  process_.reset();
  close_all();
}

/// If no picture was drawn, no empty file remains, and an earlier picture is unchanged.
void Gnuplot::close_all() noexcept {
  struct stat status {};
  if (leaves_nothing_ && fstat(file_, &status) == 0 && status.st_nlink > 0)
    unlink(picture_.c_str());
  for (const int descriptor : {file_, input_, drawing_, errors_})
    if (descriptor >= 0) close(descriptor);
}

/// MSG_NOSIGNAL: a gnuplot that has ended is an error to report, not a signal.
bool Gnuplot::send_all(const std::string& commands) const {
  std::string_view rest = commands;
  while (!rest.empty()) {
    const ssize_t sent = send(input_, rest.data(), rest.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    rest.remove_prefix(std::size_t(sent));
  }
  return true;
}

std::string Gnuplot::complaint() const {
  std::array<char, 2048> text{};
  const ssize_t size = pread(errors_, text.data(), text.size(), 0);
  return size > 0 ? ":\n" + std::string(text.data(), std::size_t(size)) : "";
}

void Gnuplot::draw(const std::string& commands) {
  const bool sent = send_all(commands);
  shutdown(input_, SHUT_WR);
  if (process_->wait() != 0 || !sent)
    throw FileError("gnuplot could not draw " + picture_ + complaint());
  write_picture();
}

void Gnuplot::write_picture() {
  struct stat before {};
  if (fstat(file_, &before) == 0 && S_ISREG(before.st_mode) && ftruncate(file_, 0) != 0)
    throw system_error("cannot write " + picture_, errno);
  std::array<char, 65536> part{};
  for (off_t at = 0;;) {
    const ssize_t size = pread(drawing_, part.data(), part.size(), at);
    if (size == 0) break;
    const ssize_t written = size < 0 ? -1 : write(file_, part.data(), std::size_t(size));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw system_error("cannot write " + picture_, errno);
    at += written;
  }
  struct stat status {};
  if (fstat(file_, &status) != 0 || status.st_nlink == 0)
    throw FileError(picture_ + " was removed before it was drawn");
  leaves_nothing_ = false;
}

std::string Gnuplot::quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) continue;
    result += c == '\'' ? "''" : std::string(1, c);
  }
  return result + "'";
}

}  // namespace regulus::picture
