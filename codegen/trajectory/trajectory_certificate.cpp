// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/trajectory/trajectory_certificate.hpp"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>

#include "codegen/certificate/certificate_file.hpp"
#include "codegen/certificate/certificate_question.hpp"
#include "codegen/certificate/piece_question.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/certificate/format.hpp"
#include "runtime/files/atomic_file.hpp"

namespace regulus::inline trajectory {
namespace {

template <class Step>
void with_reason(const std::string& path, Step step) {
  try {
    step();
  } catch (const std::system_error& error) {
    throw FileError("the certificate " + path + " cannot " + error.what());
  }
}

}  // namespace

TrajectoryCertificate::TrajectoryCertificate(std::string path, const TrajectoryCheck& check)
    : TrajectoryCertificate(std::move(path), check, {check.request, is_regular()}) {}

TrajectoryCertificate::TrajectoryCertificate(std::string path, const TrajectoryCheck& check,
                                             const CertifiedMotion& motion, HeldFiles* held)
    : path_(std::move(path)), held_(held) {
  if (path_.empty()) return;
  if (check.verdict == Verdict::kNoSingularity)
    write_safe(check, motion);
  else if (check.verdict == Verdict::kSingularity)
    write_singular(check, motion);
  else
    obstacle_ = "POSSIBLE PROBLEM claims nothing that could be proved";
}

void TrajectoryCertificate::write_safe(const TrajectoryCheck& check,
                                       const CertifiedMotion& motion) {
  const auto uncertain = uncertain_names(check.hull.labels);
  obstacle_ = certificate_obstacle(motion.about(piece_request(motion.request, 0), uncertain));
  if (!obstacle_.empty()) return;
  const CertifiedQuestion question = trajectory_question(motion.request, uncertain, motion.about);
  with_reason(path_, [&] {
    const auto file = std::make_shared<AtomicFile>(path_);
    file->write(fmt::format("{}\nverdict {}\nclaim {}\n{}proof\n", format::kMagic,
                            format::kNoSingularity, question.no_singularity, question.text));
    std::uint64_t leaves = 0;
    for (const PieceTree& tree : check.path.trees) {
      file->write("tree\n" + tree.lines);
      leaves += tree.leaves;
    }
    file->write(fmt::format("end {}\n", leaves));
    hold_or_put(held_, path_,
                [path = path_, file] { with_reason(path, [&] { file->put_in_place_durably(); }); });
  });
  written_ = true;
}

void TrajectoryCertificate::write_singular(const TrajectoryCheck& check,
                                           const CertifiedMotion& motion) {
  const DecidingPiece& piece = *check.deciding;
  CertifiedQuestion question = motion.about(piece_request(motion.request, piece.index),
                                            uncertain_names(piece.preparation->labels));
  obstacle_ = certificate_obstacle(question, true);
  if (!obstacle_.empty()) return;
  written_ = certify_witness(path_, std::move(question), piece.result, held_);
}

bool certify_witness(const std::string& path, CertifiedQuestion question, const Result& result,
                     HeldFiles* held) try {
  const auto writer = std::make_shared<CertificateWriter>(path, std::move(question));
  if (!writer->complete(result)) return false;
  hold_or_put(held, path, [writer] {
    try {
      writer->put_in_place();
    } catch (const std::runtime_error& error) {
      throw FileError(error.what());
    }
  });
  return true;
} catch (const std::runtime_error& error) {
  throw FileError(error.what());
}

std::string TrajectoryCertificate::line() const {
  if (path_.empty()) return "";
  return written_ ? "certificate " + path_ + '\n' : "certificate none: " + obstacle_ + '\n';
}

void TrajectoryCertificate::add_to(nlohmann::ordered_json& report) const {
  if (path_.empty()) return;
  report["certificate"] = nullptr;
  if (written_) report["certificate"] = path_;
  if (!obstacle_.empty()) report["certificate_obstacle"] = obstacle_;
}

}  // namespace regulus::trajectory
