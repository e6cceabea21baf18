// SPDX-License-Identifier: Apache-2.0
#include "runtime/checkpoint/writer.hpp"

#include <unistd.h>

#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "runtime/files/atomic_file.hpp"

namespace regulus {
namespace {

/// Calls `write`, with the checkpoint's name in its errors.
template <class Write>
void name_in_errors(const std::string& path, Write write) {
  try {
    write();
  } catch (const std::system_error& error) {
    throw std::runtime_error("the checkpoint " + path + " cannot " + error.what());
  }
}

}  // namespace

CheckpointWriter::CheckpointWriter(std::string path, CheckpointedQuestion question,
                                   Clock::duration interval, Certificate certificate)
    : path_(std::move(path)),
      question_(std::move(question)),
      interval_(interval),
      certificate_(std::move(certificate)) {}

void CheckpointWriter::require_writable() const {
  name_in_errors(path_, [&] { AtomicFile file(path_); });
}

bool CheckpointWriter::wants_pause() noexcept { return Clock::now() - last_ >= interval_; }

void CheckpointWriter::on_pause(const SearchState& state, const OpenBoxes& open) noexcept {
  try {
    save(state, open);
    failure_.clear();
    saved_ = true;
  } catch (const std::exception& error) {
    note_failure(error.what());
  }
  last_ = Clock::now();
}

/// Also works if there is no memory for the reason: a few characters need none.
void CheckpointWriter::note_failure(const char* why) noexcept try {
  failure_ = why;
} catch (const std::bad_alloc&) {
  failure_.assign("no memory");
}

void CheckpointWriter::save(const SearchState& state, const OpenBoxes& open) {
  std::optional<CertificateSoFar> certificate;
  if (certificate_) {
    certificate = certificate_();
    if (!certificate) throw std::runtime_error("the certificate cannot be written");
  }
  const std::string text = write_checkpoint(question_, state, open, certificate);
  name_in_errors(path_, [&] {
    AtomicFile file(path_);
    file.write(text);
    file.put_in_place_durably();
  });
}

void CheckpointWriter::remove() noexcept { ::unlink(path_.c_str()); }

}  // namespace regulus
