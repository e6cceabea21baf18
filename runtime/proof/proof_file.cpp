// SPDX-License-Identifier: Apache-2.0
#include "runtime/proof/proof_file.hpp"

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
#include "runtime/proof/format.hpp"
#include "runtime/proof/shards.hpp"

namespace regulus {

using namespace detail;

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
  open(descriptor);
}

/// Takes the descriptor.
void ProofFile::open(int descriptor) {
  file_.reset(descriptor < 0 ? nullptr : fdopen(descriptor, "r+"));
  if (!file_ && descriptor >= 0) {
    ::close(descriptor);
    ::unlink(temporary_.c_str());
  }
  check(file_ != nullptr, "be created");
}

ProofFile::~ProofFile() {
  if (file_ && !in_place_) ::unlink(temporary_.c_str());
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

void ProofFile::begin(std::string_view head) noexcept { put(head); }

void ProofFile::begin_tree() noexcept { put("tree\n"); }

void ProofFile::split(const Split& split) noexcept {
  note_written(std::fprintf(file_.get(), "s %" PRIu64 " %" PRIu32 " %a\n", split.parent,
                            split.variable, split.at));
}

void ProofFile::leaf(BoxId box, const char* word) noexcept {
  ++leaves_;
  note_written(std::fprintf(file_.get(), "l %" PRIu64 " %s\n", box, word));
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
  has_places_ = head.starts_with(format::kPlacesMagic);
}

bool ProofFile::must_be_cut() const {
  if (!(has_trees_ || has_places_) || shard_size_ == 0) return false;
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
  const std::string index =
      (has_places_ ? write_shards_of_places : write_shards)(temporary_, path_, shard_size_);
  AtomicFile file(path_);
  file.write(index);
  file.put_in_place_durably();
  ::unlink(temporary_.c_str());
} catch (const std::runtime_error& error) {
  throw std::runtime_error("the certificate " + path_ + " cannot " + error.what());
}

}  // namespace regulus
