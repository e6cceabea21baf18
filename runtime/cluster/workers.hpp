// SPDX-License-Identifier: Apache-2.0
// The transport between the supervisor of a search and its workers: threads of this process,
// processes of a cluster, or a simulation of either.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "runtime/cluster/unit.hpp"
#include "runtime/problem/observer.hpp"

namespace regulus::detail::cluster {

/// The knowledge of a search before its first unit. All units start from this.
struct Learned {
  AdaptiveThreshold threshold;
  WitnessCandidates candidates;
};

/// Makes a decider of units for one thread of this process.
using MakeDecider = std::function<std::unique_ptr<UnitDecider>()>;

/// The state of a search, for people.
struct Progress {
  std::uint64_t boxes = 0;         ///< evaluated, of the units that are in order
  std::optional<double> decided;   ///< part of the whole box, roughly, 0 … 1, if it is known
  std::size_t waiting = 0;         ///< units that no worker has
  std::vector<std::size_t> still;  ///< workers that did not answer in time
};

/// A message of a worker.
struct Received {
  std::size_t worker;
  std::string message;
};

class Workers {
 public:
  Workers() = default;
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  virtual ~Workers() = default;

  /// The next searches are about a matrix that their caller names in words of its own. Workers that
  /// have no kernel of it form one before such a search begins.
  virtual void turn_to(std::string topic) { static_cast<void>(topic); }
  /// Prepares the workers for the units of a search. The arguments live until end(). `make`: if the
  /// units are not those of Algorithm 1; other processes know it from the topic.
  virtual void begin(const Problem& problem, const Settings& settings, const Learned& learned,
                     const MakeDecider& make) = 0;
  /// The search is over: workers give up their units.
  virtual void end() noexcept = 0;

  /// Returns the number of workers, at least 1, the same from begin() to end().
  [[nodiscard]] virtual std::size_t count() const = 0;
  /// Returns the most seconds of work in one grant.
  [[nodiscard]] virtual double seconds_of_grant() const = 0;

  virtual void send(std::size_t worker, std::string grant) = 0;
  /// Returns a message; nullopt if none arrives within some tens of milliseconds. The caller's
  /// thread may do work of its own here.
  [[nodiscard]] virtual std::optional<Received> receive() = 0;
  /// Returns seconds since any fixed time.
  [[nodiscard]] virtual double now() const = 0;

  /// Receives the state of the search now and then.
  virtual void show(const Progress&) {}
  /// Returns the state of the workers in words, for people; empty if there is nothing to say.
  [[nodiscard]] virtual std::string describe() const { return {}; }
};

}  // namespace regulus::detail::cluster
