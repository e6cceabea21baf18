// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "codegen/use/mpi/communicator.hpp"
#include "runtime/cluster/workers.hpp"
#include "runtime/search/thread_workers.hpp"

namespace regulus::detail {

/// The knowledge of rank 0 about the others before a search.
struct Rank {
  std::string host;
  unsigned threads = 0;   ///< 0: it is not ready yet
  bool is_still = false;  ///< it did not answer in time, and sent nothing since
};

/// The threads of all ranks as workers, for rank 0. With many ranks, its first thread only brings
/// the messages.
class MpiWorkers final : public cluster::Workers {
 public:
  /// `communicator` must outlive this object. `hosts`: by rank. `threads`: of this rank.
  /// `tells`: progress is written to standard error, where a launcher takes it from.
  MpiWorkers(Communicator& communicator, const std::vector<std::string>& hosts, unsigned threads,
             bool tells);
  ~MpiWorkers() override { static_cast<void>(dismiss()); }

  /// Ranks form the matrix of a topic only when a search about it is long enough for them.
  void turn_to(std::string topic) override { topic_ = std::move(topic); }
  /// Waits until each rank has prepared the question, but not beyond the limit of time, nor beyond
  /// kSecondsOfPatience or the time that this rank took: ranks that are not ready then are named and
  /// get no work. Throws InternalError with the name of a rank that cannot.
  void begin(const Problem& problem, const Settings& settings, const cluster::Learned& learned,
             const cluster::MakeDecider& make) override;
  void end() noexcept override;
  [[nodiscard]] std::size_t count() const override;
  [[nodiscard]] double seconds_of_grant() const override;
  void send(std::size_t worker, std::string grant) override;
  /// Throws InternalError with the name of a rank that cannot go on.
  [[nodiscard]] std::optional<cluster::Received> receive() override;
  [[nodiscard]] double now() const override { return local_.now(); }
  /// Names a rank that stands still, once; and every ten seconds, if wanted, tells how
  /// far the search is.
  void show(const cluster::Progress& progress) override;
  [[nodiscard]] std::string describe() const override;

  /// Lets all ranks end, once, and waits for it. Returns false if one does not within
  /// kSecondsOfPatience, and names it.
  [[nodiscard]] bool dismiss();

 private:
  struct Place {
    unsigned rank;
    unsigned slot;  ///< the thread in the rank
  };

  void tell_topic();
  void await_ranks(const Settings& settings);
  void take_ready(const Message& message);
  [[nodiscard]] std::optional<cluster::Received> take(const Message& message);
  [[nodiscard]] std::string name_of(unsigned rank) const;
  /// Returns the threads that get work.
  [[nodiscard]] unsigned threads_of(unsigned rank) const;
  [[noreturn]] void fail(const Message& message) const;
  void tell_all(Tag tag, const std::string& bytes);
  void name_those_that_stand_still();
  void name_late(const std::set<unsigned>& ranks, const char* consequence);
  void tell_progress();

  Communicator& communicator_;
  std::vector<Rank> ranks_;
  bool first_thread_works_;
  ThreadWorkers local_;
  std::vector<Place> places_;
  std::vector<std::size_t> first_worker_;  ///< of each rank
  std::optional<std::string> topic_;       ///< if it differs from the command line's own question
  std::optional<std::string> told_topic_;
  std::uint32_t search_ = 0;
  bool searching_ = false, dismissed_ = false;
  Patience patience_;
  const bool tells_;
  cluster::Progress progress_;
  std::set<std::size_t> named_;  ///< workers that stood still
  double told_at_ = 0, asked_at_ = 0;
  std::uint64_t told_boxes_ = 0;
};

}  // namespace regulus::detail
