// SPDX-License-Identifier: Apache-2.0
// Proves the leaves of a tree, by several threads if wanted. The reader of the file hands them over.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "runtime/verifier/prover.hpp"

namespace regulus::verifier {

/// The facts that some leaves have shown together.
struct Shown {
  std::uint64_t leaves = 0;
  std::uint64_t boxes = 0;  ///< into which they were cut
  bool has_met_variety = false, has_met_point = false;
  int sign = 0;  ///< as Prover::sign
};

/// Leaves are proved in batches of a fixed size. No batch knows anything of another one, and their
/// results are taken in the order of the file. So the result does not depend on the threads.
class LeafProofs {
 public:
  /// All must outlive this object. `counts` receives the numbers of leaves and boxes.
  LeafProofs(Question& question, const Variety& variety, const Options& options, WorkClock& clock,
             Verification& counts);
  ~LeafProofs();

  /// Throws Rejection or Unfinished for the first leaf that is not proved, and names its line.
  void add(Lines& lines, Leaf leaf);
  /// Waits until all leaves are proved; throws the same. Then begins anew, as if without leaves.
  [[nodiscard]] Shown finish(Lines& lines);

 private:
  struct Failure {
    bool is_rejection;
    std::string why;
  };
  struct Batch {
    std::vector<Leaf> leaves;
    bool looks_for_points = false;
    std::vector<std::uint64_t> boxes;  ///< of each leaf that is proved
    Shown shown;
    std::optional<Failure> failure;  ///< of the leaf after those
    std::exception_ptr fault;
    bool is_done = false;
  };

  static void prove(Prover& prover, Batch& batch);
  void hand_over(Lines& lines);
  void merge(Lines& lines, const Batch& batch);
  void merge_done(Lines& lines, std::size_t most_left);
  void start_thread();
  void work() noexcept;
  [[nodiscard]] Batch* take_batch();

  Question& question_;
  const Variety& variety_;
  const Options& options_;
  WorkClock& clock_;
  Verification& counts_;
  std::unique_ptr<Prover> own_;  ///< if there is one thread
  std::unique_ptr<Batch> filling_;
  std::size_t batches_ = 0;  ///< handed over since the beginning
  Shown shown_;

  std::vector<std::thread> threads_;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::condition_variable handed_over_, done_;
  std::deque<std::unique_ptr<Batch>> waiting_;  ///< guarded by mutex_, as taken_ is
  std::size_t taken_ = 0;                       ///< of these, the first ones
};

}  // namespace regulus::verifier
