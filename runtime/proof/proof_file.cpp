// SPDX-License-Identifier: Apache-2.0
#include "runtime/proof/proof_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cinttypes>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "runtime/files/atomic_file.hpp"
#include "runtime/files/temporary.hpp"
#include "runtime/proof/shards.hpp"

namespace regulus {
namespace {

/// A file that a user or another program made is not continued: a search only continues its own.
void require_own(int descriptor, const std::string& name) {
  struct stat status {};
  const bool is_known = ::fstat(descriptor, &status) == 0;
  const char* const why = !is_known || !S_ISREG(status.st_mode) ? "it is not a regular file"
                          : status.st_uid != ::geteuid()        ? "it belongs to another user"
                          : status.st_nlink > 1                 ? "it has another name, too"
                                                                : nullptr;
  if (why != nullptr) throw std::runtime_error(name + " cannot be continued: " + why);
}

/// Renames an unfinished proof that no checkpoint continues.
bool set_aside(const std::string& name) noexcept {
  return ::access(name.c_str(), F_OK) != 0 ||
         std::rename(name.c_str(), (name + kEarlierEnding).c_str()) == 0;
}

}  // namespace

ProofFile::ProofFile(std::string path) : path_(std::move(path)) {
  sweep_temporaries(path_);
  int descriptor = -1;
  try {
    Temporary made = make_temporary_file(path_);
    temporary_ = std::move(made.name);
    descriptor = made.descriptor;
  } catch (const std::system_error& error) {
    throw std::runtime_error("the certificate " + path_ + " cannot " + error.what());
  }
  open(descriptor, "be created");
}

ProofFile::ProofFile(std::string path, Partial partial)
    : path_(std::move(path)),
      temporary_(partial_file(path_)),
      leaves_(partial.leaves),
      stays_(true),
      continues_(partial.length.has_value()) {
  if (!continues_) check(set_aside(temporary_), "be created, because an earlier one stays");
  const int mode = O_RDWR | O_NOFOLLOW | O_CLOEXEC | (continues_ ? 0 : O_CREAT | O_EXCL);
  open(::open(temporary_.c_str(), mode, 0666), continues_ ? "be continued" : "be created");
  if (continues_) continue_at(*partial.length);
}

/// Takes the descriptor.
void ProofFile::open(int descriptor, const char* what) {
  file_.reset(descriptor < 0 ? nullptr : fdopen(descriptor, "r+"));
  if (!file_ && descriptor >= 0) {
    ::close(descriptor);
    if (!continues_) ::unlink(temporary_.c_str());
  }
  check(file_ != nullptr, what);
}

void ProofFile::continue_at(std::uint64_t bytes) {
  const int descriptor = fileno(file_.get());
  const auto length = static_cast<off_t>(bytes);
  require_own(descriptor, temporary_);
  struct stat status {};
  check(::fstat(descriptor, &status) == 0, "be continued");
  if (status.st_size < length)
    throw std::runtime_error("the certificate " + path_ + " cannot be continued: " + temporary_ +
                             " is shorter than the checkpoint says");
  check(::ftruncate(descriptor, length) == 0 && ::fseeko(file_.get(), length, SEEK_SET) == 0,
        "be continued");
}

ProofFile::~ProofFile() {
  if (file_ && !in_place_ && !stays_) ::unlink(temporary_.c_str());
}

void ProofFile::check(bool done, const char* what) const {
  if (done) return;
  throw std::runtime_error("the certificate " + path_ + " cannot " + what + ": " +
                           std::strerror(errno));
}

/// A failure to write stays recorded in the file.
void ProofFile::put(std::string_view text) noexcept {
  std::fwrite(text.data(), 1, text.size(), file_.get());
}

/// Formatting may also need memory. If a line is missing for that reason, the file has no error.
void ProofFile::note_written(int count) noexcept {
  if (count < 0 && std::ferror(file_.get()) == 0) failed_ = true;
}

void ProofFile::begin(std::string_view head) noexcept {
  if (!continues_) put(head);
}

void ProofFile::begin_tree() noexcept { put("tree\n"); }

void ProofFile::split(const Split& split) noexcept {
  note_written(std::fprintf(file_.get(), "s %" PRIu64 " %" PRIu32 " %a\n", split.parent,
                            split.variable, split.at));
}

void ProofFile::leaf(BoxId box, const char* word) noexcept {
  ++leaves_;
  note_written(std::fprintf(file_.get(), "l %" PRIu64 " %s\n", box, word));
}

std::optional<std::uint64_t> ProofFile::sync() noexcept {
  if (failed_ || std::fflush(file_.get()) != 0 || std::ferror(file_.get()) != 0 ||
      ::fsync(fileno(file_.get())) != 0)
    return std::nullopt;
  const off_t length = ::ftello(file_.get());
  if (length < 0) return std::nullopt;
  return static_cast<std::uint64_t>(length);
}

void ProofFile::make_safe() {
  check(std::fflush(file_.get()) == 0 && std::ferror(file_.get()) == 0 &&
            ::fsync(fileno(file_.get())) == 0,
        "be written");
}

void ProofFile::complete() {
  put("end " + std::to_string(leaves_) + '\n');
  if (failed_) throw std::runtime_error("the certificate " + path_ + ": not enough memory");
  make_safe();
}

void ProofFile::complete_with(std::string_view head, std::string_view witness) {
  check(std::fflush(file_.get()) == 0 && ::ftruncate(fileno(file_.get()), 0) == 0 &&
            std::fseek(file_.get(), 0, SEEK_SET) == 0,
        "be written");
  put(head);
  put(witness);
  make_safe();
  has_trees_ = false;
}

bool ProofFile::must_be_cut() const {
  if (!has_trees_ || shard_size_ == 0) return false;
  struct stat status {};
  check(::fstat(fileno(file_.get()), &status) == 0, "be put in its place");
  return static_cast<std::uint64_t>(status.st_size) > shard_size_;
}

void ProofFile::put_in_place() {
  if (must_be_cut())
    put_index_in_place();
  else
    check(std::rename(temporary_.c_str(), path_.c_str()) == 0, "be put in its place");
  sync_folder_of(path_);
  in_place_ = true;
}

/// The index comes last. So it exists only if all shards do.
void ProofFile::put_index_in_place() try {
  const std::string index = write_shards(temporary_, path_, shard_size_);
  AtomicFile file(path_);
  file.write(index);
  file.put_in_place_durably();
  ::unlink(temporary_.c_str());
} catch (const std::runtime_error& error) {
  throw std::runtime_error("the certificate " + path_ + " cannot " + error.what());
}

}  // namespace regulus
