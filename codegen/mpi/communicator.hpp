// SPDX-License-Identifier: GPL-3.0-or-later
// The processes that MPI started together. All calls of MPI are here.
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace regulus::inline mpi {

enum class Tag : int {
  kReady = 1,  ///< a rank can begin to decide units
  kTopic,      ///< to all other ranks: the matrix of the next search, which they form
  kSearch,     ///< to all other ranks: a search begins
  kGrant,
  kAnswer,
  kEnd,    ///< the search is over
  kError,  ///< a rank cannot go on; says why
  kQuit,   ///< there will be no more searches
  kBye,    ///< the last message of a rank
};

struct Message {
  unsigned rank;  ///< of the sender
  Tag tag;
  std::string bytes;
};

/// The ranks of the program. One thread of each process uses it.
class Communicator {
 public:
  Communicator();
  ~Communicator();
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;

  [[nodiscard]] unsigned rank() const noexcept { return rank_; }
  [[nodiscard]] unsigned size() const noexcept { return size_; }
  [[nodiscard]] bool is_first() const noexcept { return rank_ == 0; }

  // All ranks call these together.

  /// Returns the text of rank 0.
  [[nodiscard]] std::string broadcast(std::string text);
  /// Returns the texts of all ranks to rank 0; nothing to the others.
  [[nodiscard]] std::vector<std::string> gather(const std::string& text);

  /// Returns at once. Two messages between two ranks arrive in their order.
  void send(unsigned rank, Tag tag, std::string bytes);
  [[nodiscard]] std::optional<Message> try_receive();
  /// Sleeps between looks, longer and longer.
  [[nodiscard]] Message receive();

  /// Ends all ranks at once.
  [[noreturn]] void abort(int exit_code);

 private:
  struct Sending;
  void forget_sent();

  unsigned rank_ = 0, size_ = 1;
  std::list<std::unique_ptr<Sending>> sending_;
};

/// Sleeps a little when there is nothing to do: longer and longer, up to a millisecond.
class Patience {
 public:
  void wait() noexcept;
  void reset() noexcept { microseconds_ = kLeast; }

 private:
  static constexpr unsigned kLeast = 20, kMost = 1000;
  unsigned microseconds_ = kLeast;
};

}  // namespace regulus::mpi
