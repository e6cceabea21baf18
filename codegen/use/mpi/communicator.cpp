// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/mpi/communicator.hpp"

#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <thread>
#include <utility>

#include "codegen/support/errors.hpp"
#include "codegen/support/exit_code.hpp"

namespace regulus::detail {
namespace {

/// MPI counts bytes with an int.
int count_of(const std::string& bytes) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw InternalError("a message between two ranks has more than 2 GB");
  return static_cast<int>(bytes.size());
}

unsigned ask(int (*function)(MPI_Comm, int*)) {
  int number = 0;
  function(MPI_COMM_WORLD, &number);
  return static_cast<unsigned>(number);
}

/// MPI begins when all ranks do, and does not tell which one does not.
constexpr unsigned kSecondsOfStart = 120;

extern "C" void end_start(int) {
  constexpr char kText[] = "regulus-mpi: a rank does not start within 120 s; the job ends\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, kText, sizeof kText - 1);
  std::_Exit(kInternalFault);
}

}  // namespace

struct Communicator::Sending {
  Text bytes;
  MPI_Request request = MPI_REQUEST_NULL;
};

Communicator::Communicator() {
  int provided = 0;
  std::signal(SIGALRM, end_start);
  ::alarm(kSecondsOfStart);
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  ::alarm(0);
  rank_ = ask(MPI_Comm_rank);
  size_ = ask(MPI_Comm_size);
  texts_.resize(size_);
}

Communicator::~Communicator() {
  for (const auto& sending : sending_) MPI_Wait(&sending->request, MPI_STATUS_IGNORE);
  MPI_Finalize();
}

// With messages between two ranks and not with the collective calls of MPI, which end only if all
// ranks take part, and do not tell which one does not.

std::string Communicator::await_text(unsigned rank) {
  Patience patience;
  while (texts_[rank].empty())
    if (!take_in()) patience.wait();
  std::string text = std::move(texts_[rank].front());
  texts_[rank].pop_front();
  return text;
}

std::string Communicator::broadcast(std::string text) {
  if (!is_first()) return await_text(0);
  const auto shared = std::make_shared<const std::string>(std::move(text));
  for (unsigned rank = 1; rank < size_; ++rank) send_shared(rank, Tag::kText, shared);
  return *shared;
}

std::vector<unsigned> Communicator::silent() const {
  std::vector<unsigned> ranks;
  for (unsigned rank = 1; rank < size_; ++rank)
    if (texts_[rank].empty()) ranks.push_back(rank);
  return ranks;
}

std::vector<std::optional<std::string>> Communicator::gather(const std::string& text,
                                                             const Silence& silence) {
  if (!is_first()) {
    send(0, Tag::kText, text);
    return {};
  }
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [begin] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  Patience patience;
  while (!silent().empty()) {
    if (silence(silent(), seconds())) break;
    if (!take_in()) patience.wait();
  }
  std::vector<std::optional<std::string>> all = {text};
  for (unsigned rank = 1; rank < size_; ++rank) {
    const bool is_lost = texts_[rank].empty();
    all.push_back(is_lost ? std::nullopt : std::optional(await_text(rank)));
    if (is_lost) lost_.insert(rank);
  }
  return all;
}

int Communicator::end(int exit_code) {
  if (!lost_.empty()) abort(exit_code);
  static_cast<void>(gather({}, [&](const std::vector<unsigned>& ranks, double seconds) {
    if (seconds < kSecondsOfPatience) return false;
    std::fprintf(stderr, "regulus-mpi: %s; the job ends without\n", describe_silent(ranks).c_str());
    abort(exit_code);
  }));
  return exit_code;
}

void Communicator::forget_sent() {
  sending_.remove_if([](const std::unique_ptr<Sending>& sending) {
    int done = 0;
    MPI_Test(&sending->request, &done, MPI_STATUS_IGNORE);
    return done != 0;
  });
}

void Communicator::send(unsigned rank, Tag tag, std::string bytes) {
  send_shared(rank, tag, std::make_shared<const std::string>(std::move(bytes)));
}

void Communicator::send_shared(unsigned rank, Tag tag, Text bytes) {
  forget_sent();
  auto sending = std::make_unique<Sending>();
  sending->bytes = std::move(bytes);
  MPI_Isend(sending->bytes->data(), count_of(*sending->bytes), MPI_BYTE, static_cast<int>(rank),
            static_cast<int>(tag), MPI_COMM_WORLD, &sending->request);
  sending_.push_back(std::move(sending));
}

std::optional<Message> Communicator::try_receive() {
  while (kept_.empty())
    if (!take_in()) return std::nullopt;
  Message message = std::move(kept_.front());
  kept_.pop_front();
  return message;
}

bool Communicator::take_in() {
  int found = 0, size = 0;
  MPI_Message handle{};
  MPI_Status status{};
  MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &found, &handle, &status);
  if (found == 0) return false;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Message message{static_cast<unsigned>(status.MPI_SOURCE), static_cast<Tag>(status.MPI_TAG),
                  std::string(static_cast<std::size_t>(size), '\0')};
  MPI_Mrecv(message.bytes.data(), size, MPI_BYTE, &handle, MPI_STATUS_IGNORE);
  if (message.tag == Tag::kText)
    texts_[message.rank].push_back(std::move(message.bytes));
  else
    kept_.push_back(std::move(message));
  return true;
}

Message Communicator::receive() {
  Patience patience;
  for (;;) {
    if (std::optional<Message> message = try_receive()) return std::move(*message);
    patience.wait();
  }
}

void Communicator::abort(int exit_code) {
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::abort();
}

std::string describe_silent(const std::vector<unsigned>& ranks) {
  std::string text = ranks.size() == 1 ? "rank " : "ranks ";
  for (std::size_t i = 0; i < ranks.size(); ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(ranks[i]);
  return text + (ranks.size() == 1 ? " does not answer" : " do not answer");
}

void Patience::wait() noexcept {
  std::this_thread::sleep_for(std::chrono::microseconds(microseconds_));
  microseconds_ = std::min(2 * microseconds_, kMost);
}

}  // namespace regulus::detail
