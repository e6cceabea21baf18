// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/mpi/communicator.hpp"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <numeric>
#include <thread>
#include <utility>

#include "codegen/support/errors.hpp"

namespace regulus::inline mpi {
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

}  // namespace

struct Communicator::Sending {
  std::string bytes;
  MPI_Request request = MPI_REQUEST_NULL;
};

Communicator::Communicator() {
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  rank_ = ask(MPI_Comm_rank);
  size_ = ask(MPI_Comm_size);
}

Communicator::~Communicator() {
  for (const auto& sending : sending_) MPI_Wait(&sending->request, MPI_STATUS_IGNORE);
  MPI_Finalize();
}

std::string Communicator::broadcast(std::string text) {
  int size = is_first() ? count_of(text) : 0;
  MPI_Bcast(&size, 1, MPI_INT, 0, MPI_COMM_WORLD);
  text.resize(static_cast<std::size_t>(size));
  MPI_Bcast(text.data(), size, MPI_BYTE, 0, MPI_COMM_WORLD);
  return text;
}

std::vector<std::string> Communicator::gather(const std::string& text) {
  const int size = count_of(text);
  std::vector<int> sizes(size_), places(size_);
  MPI_Gather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
  std::exclusive_scan(sizes.begin(), sizes.end(), places.begin(), 0);
  std::string all(static_cast<std::size_t>(places.back() + sizes.back()), '\0');
  MPI_Gatherv(text.data(), size, MPI_BYTE, all.data(), sizes.data(), places.data(), MPI_BYTE, 0,
              MPI_COMM_WORLD);
  std::vector<std::string> texts;
  for (unsigned i = 0; is_first() && i < size_; ++i)
    texts.push_back(
        all.substr(static_cast<std::size_t>(places[i]), static_cast<std::size_t>(sizes[i])));
  return texts;
}

void Communicator::forget_sent() {
  sending_.remove_if([](const std::unique_ptr<Sending>& sending) {
    int done = 0;
    MPI_Test(&sending->request, &done, MPI_STATUS_IGNORE);
    return done != 0;
  });
}

void Communicator::send(unsigned rank, Tag tag, std::string bytes) {
  forget_sent();
  auto sending = std::make_unique<Sending>();
  sending->bytes = std::move(bytes);
  MPI_Isend(sending->bytes.data(), count_of(sending->bytes), MPI_BYTE, static_cast<int>(rank),
            static_cast<int>(tag), MPI_COMM_WORLD, &sending->request);
  sending_.push_back(std::move(sending));
}

std::optional<Message> Communicator::try_receive() {
  int found = 0, size = 0;
  MPI_Message handle{};
  MPI_Status status{};
  MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &found, &handle, &status);
  if (found == 0) return std::nullopt;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Message message{static_cast<unsigned>(status.MPI_SOURCE), static_cast<Tag>(status.MPI_TAG),
                  std::string(static_cast<std::size_t>(size), '\0')};
  MPI_Mrecv(message.bytes.data(), size, MPI_BYTE, &handle, MPI_STATUS_IGNORE);
  return message;
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

void Patience::wait() noexcept {
  std::this_thread::sleep_for(std::chrono::microseconds(microseconds_));
  microseconds_ = std::min(2 * microseconds_, kMost);
}

}  // namespace regulus::mpi
