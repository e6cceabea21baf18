// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <iterator>

#include "codegen/answer/key_groups.hpp"

namespace regulus::detail {
namespace {

constexpr Key kHead[] = {
    {"model", "text"},
    {"model_file", "text", "as it was opened"},
    {"model_sha256", "sha256"},
    {"motion", "text"},
    {"question", "question"},
    {"options", "options", "of the search"},
    {"version", "text", "of Regulus"},
    {"engine", "text", "what evaluated the kernel"},
    {"threads", "count"},
    {"boxes", "count", "that were evaluated"},
    {"seconds", "seconds"},
    {"claim", "text?", "what is proved, in words; null: nothing"},
    {"verdict", "text"},
    {"proof", "proof[]", "the certificates, or why there are none"},
};

/// What is asked about one motion.
constexpr Key kSubject[] = {
    {"notes", "text[]", "about the question"},
    {"where", "text", "which poses of the motion the claim is about; empty: all"},
    {"matrix", "text", "which matrix may lose rank"},
    {"matrix_notes", "text[]", "of the model"},
    {"alpha", "approx", "the threshold of the determinant; 0: full rank"},
    {"alpha_enclosure", "enclosure"},
};

constexpr Key kMethod[] = {
    {"method", "text"},
    {"without", "text[]", "the ingredients that were left out"},
    {"forms", "full|small-parts|as-written?",
     "the detail of the functions; null: none were formed"},
    {"engine_boxes", "engine_boxes"},
    {"isa", "text", "the instruction set"},
    {"cache", "text"},
    {"bits", "count", "the most that the search computed with"},
};

constexpr Key kNotes[] = {{"notes?", "text[]", "from Python: about numbers that were floats"}};
constexpr Key kReason[] = {
    {"reason", "text", "why this is the verdict"},
    {"meaning?", "text?", "the claim in plain words; null: nothing is proved"},
};
constexpr Key kNonempty[] = {
    {"nonempty", "flag?", "whether the constraints leave any pose; null: not known"}};
constexpr Key kBoxes[] = {
    {"max_frontier", "count", "the most boxes that waited"},
    {"probes", "count", "points at which a determinant was computed to find a witness"},
};
constexpr Key kWitness[] = {
    {"witness", "witness?", "the proof of a singularity"},
    {"undefined?", "undefined", "where an expression has no value"},
};
constexpr Key kBlocking[] = {
    {"blocking_box", "range{}?", "the box that could not be decided"},
    {"blocking_pose?", "range{}", "its pose at which uncertain quantities alone defeat the test"},
};
constexpr Key kCertificate[] = {
    {"certificate?", "text?", "the file; null: there is none"},
    {"certificate_obstacle?", "text", "why there is none"},
    {"certificate_note?", "text", "why the verifier may not finish"},
};
constexpr Key kCheck[] = {
    {"kernel", "edited_kernel?", "the text whose functions the claim is about; null: the model's"},
    {"filters", "filter[]"},
    {"leaves", "count{}", "certified boxes by the test that certified them"},
    {"nearest_singular?", "nearest_singular", "where the matrix is nearest to losing rank"},
};

constexpr Key kClosure[] = {
    {"branch?", "branch", "of a closure: where it starts"},
    {"folds?", "fold[]", "singular configurations of a closure"},
    {"links?", "count", "pairs of boxes of a closure that hold the same configuration"},
};

constexpr Key kPage[] = {{"page?", "text", "the file that regulus report wrote"}};

constexpr Key kPaving[] = {
    {"resolution", "approx", "part of each range"},
    {"unit", "text", "of the volumes"},
    {"volume", "enclosure", "of the ranges"},
    {"free", "share"},
    {"singular", "share"},
    {"undecided", "share"},
    {"outside", "share"},
    {"unreachable", "share"},
    {"unfinished", "share", "of the undecided boxes, those that were not searched"},
    {"workspace", "workspace?", "the part of the ranges that meets the constraints"},
    {"stopped_by", "text?", "the limit that ended the search"},
};

/// What is asked about a motion along way-points.
constexpr Key kWay[] = {
    {"waypoints", "waypoints"},
    {"notes", "text[]", "about the file"},
    {"searched_alone", "count", "segments with a search of their own"},
};
constexpr Key kWayMatrix[] = {
    {"matrix", "text", "which matrix may lose rank"},
    {"alpha", "approx", "the threshold of the determinant; 0: full rank"},
    {"alpha_enclosure", "enclosure"},
    {"max_frontier", "count", "the most boxes that waited"},
};
constexpr Key kSegment[] = {{"segment", "segment?", "the segment that decides"}};
constexpr Key kEndOfWay[] = {
    {"segment?", "segment?",
     "the first one that is singular; of a closure where its branch ends; null: none"},
    {"witness?", "witness?", "the proof of a singularity"},
};
constexpr Key kExcluded[] = {
    {"excluded", "count", "segments without a pose that the claim is about"}};
constexpr Key kStretches[] = {
    {"resolution", "approx", "part of a segment"},
    {"stretches", "count"},
    {"share", "approx{}", "of the time or of the segments, by claim"},
};

constexpr Key kBracket[] = {
    {"margin", "growing", "what grows"},
    {"bracket", "text"},
    {"certified", "rounded?", "the largest safe value"},
    {"certified_exact", "exact?"},
    {"certified_claim", "text?"},
    {"refuted", "rounded?", "the least value that is not safe"},
    {"refuted_exact", "exact?"},
    {"refuted_claim", "text?"},
    {"gap", "approx?", "relative to the upper end"},
    {"gap_wanted", "approx"},
    {"closed", "flag", "the bracket is as narrow as wanted"},
    {"steps", "step[]", "one search after another"},
};
constexpr Key kLimitMargin[] = {
    {"limit", "text", "what must hold"},
    {"limit_exact", "exact"},
    {"quantity", "quantity"},
    {"waypoints?", "waypoints"},
    {"components", "component_margin[]"},
};

constexpr Key kOfSolutions[] = {
    {"solution_units", "text{}", "by unknown"},
    {"notes", "text[]", "about the question"},
};
constexpr Key kPlaces[] = {
    {"places_file?", "places_file", "absent: a program gave them"},
    {"places", "solved_place[]", "in their order"},
    {"places_left", "count", "that were not asked any more, after an interrupt"},
};

constexpr Key kDatasheet[] = {
    {"interrupted", "flag"},
    {"bounds", "sheet_entry[]"},
    {"not_bounded", "text[]", "quantities without a bound, and why"},
};

constexpr Key kForces[] = {
    {"load", "text"},
    {"forces", "enclosure[]", "what each motor can exert, in force_unit"},
    {"force_unit", "text"},
    {"reason", "text?", "why neither was shown"},
    {"witness", "force_witness?", "a pose and a wrench that is not held"},
    {"stopped_by", "text?", "the limit that ended the search"},
};
constexpr Key kForceShares[] = {{"boxes_by_claim?", "claim_share{}", "of a paving"}};

constexpr const char* kOfMatrix = "no-singularity|singularity|possible-problem";
constexpr const char* kOfBracket = "closed|open|refuted";
constexpr const char* kOfBound = "closed|open|refuted|within|exceeded|possible-problem";
constexpr const char* kOfForces = "feasible|infeasible|possible-problem";

/// One search over a motion.
std::vector<ObjectKind> kinds_of_searches() {
  return {
      {"check",
       "check",
       {kReason, kSubject, kMethod, kBoxes, kCheck, kClosure, kNonempty, kWitness, kBlocking, kPage,
        kCertificate},
       kOfMatrix},
      {"path",
       "check of a motion along way-points",
       {kReason, kWay, kWayMatrix, kMethod, kClosure, kExcluded, kSegment, kWitness, kPage,
        kCertificate},
       kOfMatrix},
      {"paving",
       "locate",
       {kReason, kSubject, kMethod, kBoxes, kPaving, kClosure, kNonempty, kWitness, kCertificate},
       kOfMatrix},
      {"path_paving",
       "locate of a motion along way-points",
       {kReason, kWay, kWayMatrix, kMethod, kStretches, kClosure, kEndOfWay, kCertificate},
       kOfMatrix},
  };
}

/// Brackets, solutions and loads.
std::vector<ObjectKind> kinds_of_other_answers() {
  return {
      {"margin",
       "margin",
       {kReason, kNotes, kMethod, kBracket, kClosure, kNonempty, kWitness, kEndProofs},
       kOfBracket},
      {"path_margin",
       "margin of a motion along way-points",
       {kReason, kWay, kWayMatrix, kMethod, kBracket, kClosure, kNonempty, kSegment, kWitness,
        kEndProofs},
       kOfBracket},
      {"limit_margin",
       "margin --quantity --limit",
       {kReason, kNotes, kBracket, kNonempty, kLimitMargin},
       kOfBracket},
      {"bound", "bound", {kNotes, kBound}, kOfBound},
      {"datasheet", "datasheet", {kDatasheet}, kOfBracket},
      {"solutions", "solve", {kOfSolutions, kSolve, kCertificate}, "complete|none|incomplete"},
      {"solutions_at_places",
       "solve at many places",
       {kOfSolutions, kPlaces, kCertificate},
       "complete|none|incomplete"},
      {"forces",
       "check --load and locate --load",
       {kForces, kSubject, kNonempty, kBlocking, kForceShares, kClosure, kCertificate},
       kOfForces},
      {"path_forces",
       "check --load of a motion along way-points",
       {kForces, kWay, kExcluded, kSegment, kNonempty, kBlocking, kClosure, kCertificate},
       kOfForces},
      {"path_force_paving",
       "locate --load of a motion along way-points",
       {kForces, kWay, kExcluded, kSegment, kNonempty, kBlocking, kStretches, kClosure,
        kCertificate},
       kOfForces},
  };
}

}  // namespace

std::span<const Key> head_keys() { return kHead; }

const std::vector<ObjectKind>& report_kinds() {
  static const std::vector<ObjectKind> kinds = [] {
    std::vector<ObjectKind> all = kinds_of_searches();
    std::ranges::move(kinds_of_other_answers(), std::back_inserter(all));
    return all;
  }();
  return kinds;
}

}  // namespace regulus::detail
