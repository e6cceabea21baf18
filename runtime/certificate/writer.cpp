// SPDX-License-Identifier: Apache-2.0
#include "runtime/certificate/writer.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cinttypes>
#include <cstring>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "runtime/certificate/format.hpp"
#include "runtime/certificate/shards.hpp"
#include "runtime/files/atomic_file.hpp"
#include "runtime/files/temporary.hpp"

namespace regulus {
namespace {

const char* word_of(Reason reason) noexcept {
  if (reason == Reason::kSmallDeterminant) return format::kSmallDeterminant;
  if (reason == Reason::kLostRank) return format::kLostRank;
  return reason == Reason::kAlwaysSingular ? format::kAlwaysSingular : format::kOppositeSigns;
}

/// Requires  `place` is an end.
std::string word_of(PlaceInRange place) {
  return place == PlaceInRange::kUpperEnd ? format::kUpperEnd : format::kLowerEnd;
}

/// For an enclosure of a number other than 0: the end next to 0 may have been rounded to 0.
bool is_positive(const Interval& x) noexcept { return x.lo >= 0.0 && x.hi > 0.0; }

std::string hexadecimal(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%a", x);
  return text;
}

std::string text_of(const ExactNumber& number) {
  return format::kExactValue + std::to_string(number.numerator) +
         (number.of_pi != 0 ? "*pi/" : "/") + std::to_string(number.denominator);
}

std::string coordinate(const WitnessPoint& point, std::size_t k) {
  if (!point.places.empty() && point.places[k] != PlaceInRange::kInside)
    return word_of(point.places[k]);
  if (!point.numbers.empty() && point.numbers[k].denominator > 0) return text_of(point.numbers[k]);
  const Interval& x = point.variables[k];
  return hexadecimal(x.lo) + (x.hi != x.lo ? ':' + hexadecimal(x.hi) : "");
}

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

const char* certificate_word(Rule rule) noexcept {
  switch (rule) {
    case Rule::kOutside:
      return "outside";
    case Rule::kHMatrix:
      return "h-matrix";
    case Rule::kMeanValue:
      return "mean-value";
    case Rule::kSecondOrder:
      return "second-order";
    case Rule::kOrthants:
      return "orthants";
    case Rule::kDeterminant:
      return "determinant";
    case Rule::kElimination:
      return "elimination";
    case Rule::kRohn:
      return "rohn";
    case Rule::kClosedForm:
      return "closed-form";
    case Rule::kFilter:
      return "filter";
    case Rule::kMultiprecision:
      return "multiprecision";
    case Rule::kWitness:
    case Rule::kBlocked:
      break;
  }
  return "none";
}

CertificateWriter::CertificateWriter(std::string path, CertifiedQuestion question)
    : path_(std::move(path)), question_(std::move(question)) {
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

CertificateWriter::CertificateWriter(std::string path, CertifiedQuestion question, Partial partial)
    : path_(std::move(path)),
      temporary_(partial_file(path_)),
      question_(std::move(question)),
      leaves_(partial.leaves),
      stays_(true),
      continues_(partial.length.has_value()) {
  if (!continues_) check(set_aside(temporary_), "be created, because an earlier one stays");
  const int mode = O_RDWR | O_NOFOLLOW | O_CLOEXEC | (continues_ ? 0 : O_CREAT | O_EXCL);
  open(::open(temporary_.c_str(), mode, 0666), continues_ ? "be continued" : "be created");
  if (continues_) continue_at(*partial.length);
}

/// Takes the descriptor.
void CertificateWriter::open(int descriptor, const char* what) {
  file_.reset(descriptor < 0 ? nullptr : fdopen(descriptor, "r+"));
  if (!file_ && descriptor >= 0) {
    ::close(descriptor);
    if (!continues_) ::unlink(temporary_.c_str());
  }
  check(file_ != nullptr, what);
}

void CertificateWriter::continue_at(std::uint64_t bytes) {
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

CertificateWriter::~CertificateWriter() {
  if (!in_place_ && !stays_) ::unlink(temporary_.c_str());
}

void CertificateWriter::check(bool done, const char* what) const {
  if (done) return;
  throw std::runtime_error("the certificate " + path_ + " cannot " + what + ": " +
                           std::strerror(errno));
}

/// A failure to write stays recorded in the file; finish() checks it.
void CertificateWriter::put(const std::string& text) noexcept {
  std::fputs(text.c_str(), file_.get());
}

void CertificateWriter::write_head(const char* verdict, const std::string& claim) {
  put(std::string(format::kMagic) + "\nverdict " + verdict + "\nclaim " + claim + '\n' +
      question_.text + "proof\n");
}

/// Splits and leaves are a proof of NO SINGULARITY if nothing else follows.
/// If there is no memory for them, finish() and sync() report it.
void CertificateWriter::on_start(const Problem&, const Settings&) noexcept try {
  if (!continues_) write_head(format::kNoSingularity, question_.no_singularity);
} catch (const std::bad_alloc&) {
  failed_ = true;
}

/// Formatting may also need memory. If a line is missing for that reason, the file has no error.
void CertificateWriter::note_written(int count) noexcept {
  if (count < 0 && std::ferror(file_.get()) == 0) failed_ = true;
}

void CertificateWriter::on_split(const OpenBox&, const Split& split) noexcept {
  note_written(std::fprintf(file_.get(), "s %" PRIu64 " %" PRIu32 " %a\n", split.parent,
                            split.variable, split.at));
}

void CertificateWriter::on_leaf(const OpenBox& box, Rule rule, const Proof&) noexcept {
  ++leaves_;
  note_written(std::fprintf(file_.get(), "l %" PRIu64 " %s\n", box.id, certificate_word(rule)));
}

void CertificateWriter::write_point(const WitnessPoint& point, const char* sign) {
  std::string line = std::string("point ") + sign;
  for (std::size_t k = 0; k < point.variables.size(); ++k) line += ' ' + coordinate(point, k);
  put(line + '\n');
}

void CertificateWriter::write_witness(const Result& result) {
  put(std::string("reason ") + word_of(result.reason) + '\n');
  const bool signs = result.reason == Reason::kOppositeSigns;
  for (const WitnessPoint& point : result.witness->points)
    write_point(point, !signs ? "0" : is_positive(point.determinant) ? "+" : "-");
  if (signs) put("path segment\n");
  put("end\n");
}

std::optional<std::uint64_t> CertificateWriter::sync() noexcept {
  if (failed_ || std::fflush(file_.get()) != 0 || std::ferror(file_.get()) != 0 ||
      ::fsync(fileno(file_.get())) != 0)
    return std::nullopt;
  const off_t length = ::ftello(file_.get());
  if (length < 0) return std::nullopt;
  return static_cast<std::uint64_t>(length);
}

bool CertificateWriter::finish(const Result& result) {
  if (!complete(result)) return false;
  put_in_place();
  return true;
}

bool CertificateWriter::complete(const Result& result) {
  if (result.verdict == Verdict::kPossibleProblem) return false;
  if (result.verdict == Verdict::kSingularity) {
    check(std::fflush(file_.get()) == 0 && ftruncate(fileno(file_.get()), 0) == 0 &&
              std::fseek(file_.get(), 0, SEEK_SET) == 0,
          "be written");
    write_head(format::kSingularity, question_.singularity);
    write_witness(result);
    failed_ = false;
  } else {
    put("end " + std::to_string(leaves_) + '\n');
  }
  if (failed_) throw std::runtime_error("the certificate " + path_ + ": not enough memory");
  check(std::fflush(file_.get()) == 0 && std::ferror(file_.get()) == 0 &&
            fsync(fileno(file_.get())) == 0,
        "be written");
  is_safe_ = result.verdict == Verdict::kNoSingularity;
  return true;
}

void CertificateWriter::put_in_place() {
  struct stat status {};
  check(::fstat(fileno(file_.get()), &status) == 0, "be put in its place");
  const bool is_cut =
      is_safe_ && shard_size_ > 0 && static_cast<std::uint64_t>(status.st_size) > shard_size_;
  if (is_cut)
    put_index_in_place();
  else
    check(std::rename(temporary_.c_str(), path_.c_str()) == 0, "be put in its place");
  sync_folder_of(path_);
  in_place_ = true;
}

/// The index comes last. So it exists only if all shards do.
void CertificateWriter::put_index_in_place() try {
  const std::string index = write_shards(temporary_, path_, shard_size_);
  AtomicFile file(path_);
  file.write(index);
  file.put_in_place_durably();
  ::unlink(temporary_.c_str());
} catch (const std::runtime_error& error) {
  throw std::runtime_error("the certificate " + path_ + " cannot " + error.what());
}

}  // namespace regulus
