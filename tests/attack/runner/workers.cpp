// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/runner/workers.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace regulus::detail::attack {
namespace {

constexpr int kPollMilliseconds = 50;
constexpr int kModelsPerProcess = 400;  ///< limits the memory that leaking models take
constexpr double kWallFactor = 8;       ///< a model that waits for ever uses no processor time
constexpr std::uint64_t kNone = ~std::uint64_t{0};

double seconds_of(clockid_t clock) {
  timespec now{};
  if (clock_gettime(clock, &now) != 0) return 0;
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The present work of a worker, in memory that it shares with its parent.
struct Slot {
  std::atomic<std::uint64_t> model{kNone};
  std::atomic<Stage> stage{Stage::kCheck};
  std::atomic<int> exit_code{-1};                       ///< of the check, from the second stage on
  std::atomic<double> processor_time{0}, wall_time{0};  ///< at the beginning of the stage
};

struct Shared {
  std::atomic<std::uint64_t> next{0};
  Slot slots[1];

  static std::size_t size(unsigned slots) { return sizeof(Shared) + slots * sizeof(Slot); }
};

class SharedMemory {
 public:
  explicit SharedMemory(unsigned slots) : size_(Shared::size(slots)) {
    void* memory = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::runtime_error("no shared memory");
    shared_ = new (memory) Shared;
    for (unsigned i = 1; i < slots; ++i) new (&shared_->slots[i]) Slot;
  }
  ~SharedMemory() { munmap(shared_, size_); }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;
  Shared& operator*() const { return *shared_; }

 private:
  std::size_t size_;
  Shared* shared_;
};

std::string line_of(std::uint64_t model, const Outcome& o) {
  const nlohmann::json line = {model,
                               static_cast<int>(o.stage),
                               o.exit_code,
                               static_cast<int>(o.proof),
                               o.reason,
                               o.proof_reason,
                               o.check_seconds,
                               o.verify_seconds,
                               o.may_be_vacuous,
                               o.is_announced,
                               o.false_list};
  return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

std::pair<std::uint64_t, Outcome> outcome_in(const std::string& text) {
  const nlohmann::json line = nlohmann::json::parse(text);
  Outcome o;
  o.stage = static_cast<Stage>(line[1].get<int>());
  o.exit_code = line[2];
  o.proof = static_cast<Proof>(line[3].get<int>());
  o.reason = line[4];
  o.proof_reason = line[5];
  o.check_seconds = line[6];
  o.verify_seconds = line[7];
  o.may_be_vacuous = line[8];
  o.is_announced = line[9];
  o.false_list = line[10];
  return {line[0], o};
}

void write_all(int descriptor, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t n = write(descriptor, text.data() + at, text.size() - at);
    if (n <= 0) _exit(99);
    at += static_cast<std::size_t>(n);
  }
}

std::string messages_path(const std::string& folder) { return folder + "/messages"; }

/// Sends output that bypasses the streams (a failed assertion, say) to a file for the parent.
void send_messages_to_a_file(const std::string& folder) {
  const int file =
      open(messages_path(folder).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0600);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
}

void limit_memory(std::uint64_t bytes) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const rlimit most{bytes, bytes};
  setrlimit(RLIMIT_AS, &most);
#else
  static_cast<void>(bytes);
#endif
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
}

volatile std::sig_atomic_t g_stop = 0;

/// Ends the run on Ctrl-C after the present line, and removes its folder.
void stop_at_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { g_stop = 1; };
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

void reset_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
}

[[noreturn]] void work(const Job& job, Shared& shared, Slot& slot, const std::string& folder,
                       int out) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  reset_signals();
  send_messages_to_a_file(folder);
  limit_memory(job.limits.bytes);
  const Run run{folder, job.mutant, job.verify, [&slot](Stage stage, int exit_code) {
                  slot.processor_time = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
                  slot.wall_time = seconds_of(CLOCK_MONOTONIC);
                  slot.stage = stage;
                  slot.exit_code = exit_code;
                }};
  for (int i = 0; i < kModelsPerProcess; ++i) {
    const std::uint64_t model = shared.next++;
    if (model >= job.count) break;
    run.entering(Stage::kCheck, -1);
    slot.model = model;
    write_all(out, line_of(model, attack_with(job.make(model), run)));
    slot.model = kNone;
    if (ftruncate(STDERR_FILENO, 0) != 0) _exit(99);
  }
  _exit(0);
}

class Worker {
 public:
  Worker(const Job& job, Shared& shared, Slot& slot, std::string folder)
      : job_(job), shared_(shared), slot_(slot), folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
    start();
  }
  ~Worker() {
    if (pid_ > 0) stop();
    close(out_);
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  [[nodiscard]] int descriptor() const { return out_; }

  /// Reads the available lines; returns false when the worker has ended.
  bool read_lines() {
    char buffer[65536];
    const ssize_t n = read(out_, buffer, sizeof buffer);
    if (n <= 0) return n < 0 && errno == EINTR;
    text_.append(buffer, static_cast<std::size_t>(n));
    for (std::size_t end; (end = text_.find('\n')) != std::string::npos;) {
      const auto [model, outcome] = outcome_in(text_.substr(0, end));
      text_.erase(0, end + 1);
      reported_ = model;
      job_.done(model, outcome);
    }
    return true;
  }

  void stop_if_slow() {
    if (stopped_ || slot_.model.load() == kNone) return;
    clockid_t clock{};
    if (clock_getcpuclockid(pid_, &clock) != 0) return;
    const double spent = seconds_of(clock) - slot_.processor_time;
    const double waited = seconds_of(CLOCK_MONOTONIC) - slot_.wall_time;
    if (spent <= job_.limits.seconds && waited <= kWallFactor * job_.limits.seconds) return;
    stopped_ = true;
    kill(pid_, SIGKILL);
  }

  /// Call it after the worker ended: reports its model as done. Returns whether work remains.
  bool restart() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    close(out_);
    out_ = -1;
    const std::uint64_t model = slot_.model.exchange(kNone);
    if (model != kNone && model != reported_) job_.done(model, ending(status));
    if (shared_.next.load() >= job_.count) return false;
    start();
    return true;
  }

 private:
  void start() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    text_.clear();
    stopped_ = false;
    reported_ = kNone;
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("no process");
    if (pid_ == 0) {
      close(ends[0]);
      work(job_, shared_, slot_, folder_, ends[1]);
    }
    close(ends[1]);
    out_ = ends[0];
  }

  void stop() const {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }

  [[nodiscard]] Outcome ending(int status) const {
    Outcome outcome;
    outcome.stage = slot_.stage;
    outcome.exit_code = slot_.exit_code;
    outcome.ending = stopped_ ? Ending::kSlow : Ending::kCrashed;
    if (outcome.stage == Stage::kVerify) outcome.proof = Proof::kBroken;
    if (stopped_)
      outcome.reason = "stopped at the limit of time";
    else if (WIFSIGNALED(status))
      outcome.reason = std::string("signal: ") + strsignal(WTERMSIG(status));
    else
      outcome.reason = "the process ended with code " + std::to_string(WEXITSTATUS(status));
    std::ostringstream messages;
    messages << std::ifstream(messages_path(folder_)).rdbuf();
    outcome.reason += "; " + messages.str().substr(0, 400);
    outcome.proof_reason = outcome.reason;
    return outcome;
  }

  const Job& job_;
  Shared& shared_;
  Slot& slot_;
  std::string folder_, text_;
  pid_t pid_ = -1;
  int out_ = -1;
  bool stopped_ = false;
  std::uint64_t reported_ = kNone;
};

/// A folder, in memory if possible, that is removed at the end.
class Folder {
 public:
  Folder() {
    const bool memory = access("/dev/shm", W_OK) == 0;
    const auto parent =
        memory ? std::filesystem::path("/dev/shm") : std::filesystem::temp_directory_path();
    std::string pattern = (parent / "regulus-attack-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no folder " + pattern);
    path_ = pattern;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace

bool run_all(const Job& job) {
  const Folder folder;
  const SharedMemory memory(job.processes);
  std::vector<std::unique_ptr<Worker>> workers;
  for (unsigned i = 0; i < job.processes; ++i)
    workers.push_back(std::make_unique<Worker>(job, *memory, (*memory).slots[i],
                                               folder.path() + "/" + std::to_string(i)));
  stop_at_signals();
  while (!workers.empty() && g_stop == 0) {
    std::vector<pollfd> waiting;
    for (const auto& worker : workers) waiting.push_back({worker->descriptor(), POLLIN, 0});
    poll(waiting.data(), waiting.size(), kPollMilliseconds);
    for (std::size_t i = workers.size(); i-- > 0;) {
      workers[i]->stop_if_slow();
      if (waiting[i].revents == 0 || workers[i]->read_lines()) continue;
      if (!workers[i]->restart()) workers.erase(workers.begin() + static_cast<long>(i));
    }
  }
  return g_stop == 0;
}

}  // namespace regulus::detail::attack
