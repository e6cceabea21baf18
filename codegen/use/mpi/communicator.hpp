// SPDX-License-Identifier: GPL-3.0-or-later
// The processes that MPI started together. All calls of MPI are here.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace regulus::detail {

enum class Tag : int {
  kReady = 1,  ///< a rank can begin to decide units
  kTopic,      ///< to all other ranks: the matrix of the next search, which they form
  kSearch,     ///< to all other ranks: a search begins
  kGrant,
  kAnswer,
  kEnd,    ///< the search is over
  kError,  ///< a rank cannot go on; says why
  kQuit,   ///< there will be no more searches
  kBye,    ///< the last message of a rank after searches
  kText,   ///< of broadcast() and gather()
};

struct Message {
  unsigned rank;  ///< of the sender
  Tag tag;
  std::string bytes;
};

/// A rank that should answer has this much time, in seconds.
constexpr double kSecondsOfPatience = 60.0;

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

  /// Called on rank 0 now and then while it waits for other ranks, with the seconds since it began.
  /// Returns true if it shall not wait for them.
  using Silence = std::function<bool(const std::vector<unsigned>& ranks, double seconds)>;

  // All ranks call these together.

  /// Returns the text of rank 0.
  [[nodiscard]] std::string broadcast(std::string text);
  /// Returns the texts of all ranks to rank 0, without that of a rank that it did not wait for;
  /// nothing to the others.
  [[nodiscard]] std::vector<std::optional<std::string>> gather(const std::string& text,
                                                               const Silence& silence);
  /// Returns the exit code when all ranks have come to their end. If one does not in time, rank 0
  /// names it and ends the job.
  [[nodiscard]] int end(int exit_code);

  /// Returns at once. Two messages between two ranks arrive in their order.
  void send(unsigned rank, Tag tag, std::string bytes);
  [[nodiscard]] std::optional<Message> try_receive();
  /// Sleeps between looks, longer and longer.
  [[nodiscard]] Message receive();

  /// Ends all ranks at once.
  [[noreturn]] void abort(int exit_code);

 private:
  struct Sending;
  using Text = std::shared_ptr<const std::string>;
  void forget_sent();
  void send_shared(unsigned rank, Tag tag, Text bytes);
  /// Takes one message from another rank, if there is one, into texts_ or kept_.
  bool take_in();
  [[nodiscard]] std::string await_text(unsigned rank);
  [[nodiscard]] std::vector<unsigned> silent() const;

  unsigned rank_ = 0, size_ = 1;
  std::list<std::unique_ptr<Sending>> sending_;
  std::vector<std::deque<std::string>> texts_;  ///< by rank: they arrived, and wait to be taken
  /// Other messages in their order: one may arrive while a rank waits for a text.
  std::deque<Message> kept_;
  std::set<unsigned> lost_;  ///< ranks that were given up
};

/// Returns "rank 3 does not answer", or "ranks 3, 5 do not answer".
[[nodiscard]] std::string describe_silent(const std::vector<unsigned>& ranks);

/// Sleeps a little when there is nothing to do: longer and longer, up to a millisecond.
class Patience {
 public:
  void wait() noexcept;
  void reset() noexcept { microseconds_ = kLeast; }

 private:
  static constexpr unsigned kLeast = 20, kMost = 1000;
  unsigned microseconds_ = kLeast;
};

}  // namespace regulus::detail
