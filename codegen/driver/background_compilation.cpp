// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/background_compilation.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

namespace regulus::codegen {
namespace {

// The first letter of the answer; a reason follows.
constexpr char kCompiled = 'k';
constexpr char kFailed = 'f';

/// The parent blocks the signals that end a search, or handles them; here they end the process.
void take_signals() noexcept {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) std::signal(signal, SIG_DFL);
  std::signal(SIGPIPE, SIG_IGN);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// Away from the terminal and from whoever reads what this process writes: nobody is to wait for
/// the end of the other one, and an interrupt is for this one.
void detach() noexcept {
  ::setsid();
  take_signals();
  const int nothing = ::open("/dev/null", O_RDWR);
  if (nothing < 0) ::_exit(1);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nothing, stream);
}

std::string compile(const machine::PackKernel& program, const CompileOptions& options,
                    const std::function<void()>& after) try {
  if (const auto fault = rounding_self_test(options))
    return kFailed + ("the rounding self-test failed: " + *fault);
  static_cast<void>(compile_kernel(program, options));
  after();
  return {kCompiled};
} catch (const std::exception& error) {
  return kFailed + std::string(error.what());
}

/// Never returns to what belongs to the process that it was made from: no destructor runs, and what
/// cannot be said for want of memory is an end without an answer.
[[noreturn]] void answer_and_exit(int to, const machine::PackKernel& program,
                                  const CompileOptions& options,
                                  const std::function<void()>& after) noexcept try {
  detach();
  const std::string answer = compile(program, options, after);
  std::size_t done = 0;
  while (done < answer.size()) {
    const ssize_t count = ::write(to, answer.data() + done, answer.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    done += static_cast<std::size_t>(count);
  }
  ::_exit(0);
} catch (...) {
  ::_exit(1);
}

}  // namespace

BackgroundCompilation::BackgroundCompilation(std::shared_ptr<const machine::PackKernel> program,
                                             const CompileOptions& options,
                                             const std::function<void()>& after)
    : program_(std::move(program)), options_(options) {
  if (options_.cache_directory.empty()) options_.cache_directory = default_cache_directory();
  lock_ =
      FileDescriptor(::open(options_.cache_directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw NoCompiler(std::string("no pipe to the compiler: ") + std::strerror(errno));
  answer_ = FileDescriptor(ends[0]);
  const FileDescriptor to(ends[1]);
  process_ = ::fork();
  if (process_ == 0) answer_and_exit(to.get(), *program_, options, after);
  if (process_ < 0)
    throw NoCompiler(std::string("no process for the compiler: ") + std::strerror(errno));
}

BackgroundCompilation::~BackgroundCompilation() {
  if (process_ <= 0 || ::waitpid(process_, nullptr, WNOHANG) != 0) return;
  if (::flock(lock_.get(), LOCK_EX | LOCK_NB) != 0) abandon();
}

void BackgroundCompilation::abandon() noexcept {
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
  process_ = -1;
}

/// Reads what there is; whether that was the end.
bool BackgroundCompilation::answered() {
  while (true) {
    pollfd ready{answer_.get(), POLLIN, 0};
    if (::poll(&ready, 1, 0) <= 0) return false;
    std::array<char, 512> buffer{};
    const ssize_t count = ::read(answer_.get(), buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return true;
    text_.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

std::optional<CompiledKernel> BackgroundCompilation::take() {
  if (!answer_ || !answered()) return std::nullopt;
  answer_ = FileDescriptor();
  const std::string words = text_.empty() ? "it ended without an answer" : text_.substr(1);
  if (text_.empty() || text_.front() != kCompiled) {
    failure_ = words;
    return std::nullopt;
  }
  auto kernel = find_cached_kernel(*program_, options_);
  if (!kernel) failure_ = "the cache does not have it";
  return kernel;
}

}  // namespace regulus::codegen
