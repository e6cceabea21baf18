// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/picture/gnuplot.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>

#include "codegen/support/errors.hpp"
#include "codegen/support/file_descriptor.hpp"

namespace regulus::detail {
namespace {

FileError cannot_start(const std::system_error& error) {
  if (error.code() != std::errc::no_such_file_or_directory)
    return FileError("cannot start gnuplot: " + error.code().message());
  return FileError(
      "gnuplot, which draws the pictures, was not found. On Debian: apt-get install gnuplot-nox");
}

AtomicFile opened(const std::string& picture) try {
  return AtomicFile(picture);
} catch (const std::system_error& error) {
  throw FileError(picture + " cannot " + error.what());
}

/// A gnuplot that could not write all of a picture reports nothing.
bool is_whole(const std::string& drawing, const std::string& file) {
  const std::string_view ending = file.ends_with(".png")   ? "IEND\xae\x42\x60\x82"
                                  : file.ends_with(".pdf") ? "%%EOF"
                                                           : "</svg>";
  const std::size_t end = drawing.find_last_not_of(" \n\r") + 1;
  return std::string_view(drawing).substr(0, end).ends_with(ending);
}

/// gnuplot names every SVG after itself.
std::string titled(std::string drawing, const std::string& title) {
  constexpr std::string_view kOwn = "<title>Gnuplot</title>";
  const std::size_t at = drawing.find(kOwn);
  if (at == std::string::npos) return drawing;
  std::string text;
  for (const char c : title)
    text += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return drawing.replace(at, kOwn.size(), "<title>" + text + "</title>");
}

}  // namespace

Gnuplot::Gnuplot(const std::string& picture) : picture_(picture), file_(opened(picture)) {
  try {
    start();
  } catch (const std::system_error& failure) {
    close_all();
    throw cannot_start(failure);
  }
}

/// -d: a file ~/.gnuplot or gnuplotrc could send the picture elsewhere.
void Gnuplot::start() {
  std::array<int, 2> ends{-1, -1};
  drawing_ = memfd_create("gnuplot-drawing", MFD_CLOEXEC);
  errors_ = memfd_create("gnuplot-errors", MFD_CLOEXEC);
  if (drawing_ < 0 || errors_ < 0 ||
      socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw std::system_error(errno, std::generic_category());
  input_ = ends[0];
  const FileDescriptor other_end(ends[1]);
  process_.emplace(std::vector<std::string>{"gnuplot", "-d"},
                   StandardStreams{other_end.get(), drawing_, errors_});
}

Gnuplot::~Gnuplot() {
  shutdown(input_, SHUT_WR);
  process_.reset();
  close_all();
}

void Gnuplot::close_all() noexcept {
  for (const int descriptor : {input_, drawing_, errors_})
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

void Gnuplot::draw(const std::string& commands, const std::string& title) {
  const bool sent = send_all(commands);
  shutdown(input_, SHUT_WR);
  if (process_->wait() != 0 || !sent)
    throw FileError("gnuplot could not draw " + picture_ + complaint());
  const std::string picture = titled(drawing(), title);
  if (!is_whole(picture, picture_))
    throw FileError("gnuplot did not finish " + picture_ +
                    "; look for a limit of file size (ulimit -f) or of memory" + complaint());
  try {
    file_.write(picture);
    file_.put_in_place();
  } catch (const std::system_error& error) {
    throw FileError(picture_ + " cannot " + error.what());
  }
}

/// Returns what gnuplot has drawn; a part of it is found to be incomplete.
std::string Gnuplot::drawing() const {
  std::string picture;
  std::array<char, 65536> part{};
  for (;;) {
    const ssize_t size = pread(drawing_, part.data(), part.size(), off_t(picture.size()));
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return picture;
    picture.append(part.data(), std::size_t(size));
  }
}

std::string Gnuplot::quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) continue;
    if (c == '>' && result.ends_with("]]")) result += "\u200b";
    result += c == '\'' ? "'.quote.'" : std::string(1, c);
  }
  return result + "'";
}

}  // namespace regulus::detail
