// SPDX-License-Identifier: Apache-2.0
#include "runtime/checkpoint/writer.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

namespace regulus {
namespace {

/// A file beside `path`, always of the same name, so that a process that was killed leaves one at
/// most; it is removed unless it was put in its place.
class Replacement {
 public:
  explicit Replacement(const std::string& path) : path_(path), temporary_(path + ".new") {
    descriptor_ =
        ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail("be made");
  }
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;
  ~Replacement() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (descriptor_ >= 0 && !in_place_) ::unlink(temporary_.c_str());
  }

  void write(std::string_view text) {
    while (!text.empty()) {
      const ssize_t count = ::write(descriptor_, text.data(), text.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) fail("be written");
      text.remove_prefix(static_cast<std::size_t>(count));
    }
    if (::fsync(descriptor_) != 0) fail("be written");
  }
  void put_in_place() {
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail("be put in its place");
    in_place_ = true;
    // Without this the rename may be lost with the power, and the old file be there again.
    const std::string folder = path_.substr(0, path_.find_last_of('/') + 1);
    const int directory = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC);
    if (directory < 0) return;
    ::fsync(directory);
    ::close(directory);
  }

 private:
  [[noreturn]] void fail(const char* what) const {
    throw std::runtime_error("the checkpoint " + path_ + " cannot " + what + ": " +
                             std::strerror(errno));
  }

  const std::string& path_;
  std::string temporary_;
  int descriptor_ = -1;
  bool in_place_ = false;
};

}  // namespace

CheckpointWriter::CheckpointWriter(std::string path, CheckpointedQuestion question,
                                   Clock::duration interval, Certificate certificate)
    : path_(std::move(path)),
      question_(std::move(question)),
      interval_(interval),
      certificate_(std::move(certificate)) {}

void CheckpointWriter::require_writable() const { const Replacement probe(path_); }

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

/// Also without memory for the reason: a few characters need none.
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
  Replacement file(path_);
  file.write(write_checkpoint(question_, state, open, certificate));
  file.put_in_place();
}

void CheckpointWriter::remove() noexcept { ::unlink(path_.c_str()); }

}  // namespace regulus
