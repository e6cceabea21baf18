// SPDX-License-Identifier: Apache-2.0
// Saves a search while it runs.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "runtime/checkpoint/checkpoint.hpp"

namespace regulus {

/// An observer that saves at intervals and when the search is stopped. The old contents of the file
/// stay until the new ones are safe on the disk.
class CheckpointWriter final : public Observer {
 public:
  using Clock = std::chrono::steady_clock;
  /// Makes the certificate so far safe on the disk and describes it; nullopt if that fails.
  using Certificate = std::function<std::optional<CertificateSoFar>()>;

  CheckpointWriter(std::string path, CheckpointedQuestion question, Clock::duration interval,
                   Certificate certificate = nullptr);

  /// Throws std::runtime_error unless a file can be made beside `path`.
  void require_writable() const;

  [[nodiscard]] bool wants_pause() noexcept override;
  void on_pause(const SearchState& state, const OpenBoxes& open) noexcept override;

  /// Returns why the last attempt to save failed; empty if it did not.
  [[nodiscard]] const std::string& failure() const noexcept { return failure_; }
  [[nodiscard]] bool saved() const noexcept { return saved_; }
  /// Call it when the search is over: it removes the file.
  void remove() noexcept;

 private:
  void note_failure(const char* why) noexcept;
  void save(const SearchState& state, const OpenBoxes& open);

  std::string path_;
  CheckpointedQuestion question_;
  Clock::duration interval_;
  Certificate certificate_;
  Clock::time_point last_ = Clock::now();
  std::string failure_;
  bool saved_ = false;
};

}  // namespace regulus
