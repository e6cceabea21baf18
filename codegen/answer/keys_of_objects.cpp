// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <iterator>

#include "codegen/answer/key_groups.hpp"

namespace regulus::detail {
namespace {

constexpr Key kQuestion[] = {
    {"ranges", "range{}", "of the motion parameters"},
    {"uncertain", "uncertain_quantity[]"},
    {"groups", "group[]", "how many quantities of each group are uncertain"},
    {"units", "text{}", "by name: of parameters, pose, uncertain quantities and unknowns"},
    {"alpha", "enclosure"},
    {"where", "text"},
    {"constraints", "count"},
    {"ranges_exact", "exact[]{}"},
    {"alpha_exact", "exact"},
    {"pose_exact?", "text{}",
     "the formulas and constants that the motion gives pose parameters; not along way-points"},
    {"constraints_exact?", "text[]", "each is at most 0; not along way-points"},
    {"place?", "placed_number{}", "of solve: the numbers that are given"},
    {"held?", "text[]", "of solve: joints that keep their values"},
};
constexpr Key kOptions[] = {
    {"method", "text"},
    {"determinant", "text"},
    {"entries", "text"},
    {"bisect", "text"},
    {"weights?", "text[]", "NAME=W of each weight that was given"},
    {"uncertainty", "text"},
    {"engine", "text"},
    {"threads", "count"},
    {"max_boxes", "count?", "null: no limit"},
    {"time_limit", "approx?", "seconds; null: no limit"},
    {"precision", "count", "bits"},
    {"symbolic_budget", "count", "terms"},
    {"without", "text[]"},
};
constexpr Key kUncertain[] = {
    {"name", "text"},
    {"kind", "geometry|control"},
    {"group", "text", "empty: none"},
    {"shape", "range|ball"},
    {"unit", "text"},
    {"range", "range"},
    {"value_exact", "exact"},
    {"tolerance_exact?", "exact", "of a range"},
    {"radius_exact?", "exact", "of a ball"},
};
constexpr Key kGroup[] = {
    {"group", "text", "empty: without a group, or control errors"},
    {"kind", "geometry|control"},
    {"quantities", "count"},
};
constexpr Key kSeconds[] = {
    {"model?", "approx", "absent, with the next two: solve, which tells of its search alone"},
    {"symbolic?", "approx"},
    {"program?", "approx", "from expressions to the list of operations"},
    {"emit?", "approx", "of C++ text"},
    {"compile?", "approx", "by a compiler, or to find its code; absent: interpreted at first"},
    {"search", "approx"},
    {"total", "approx"},
};
constexpr Key kProof[] = {
    {"file", "text?", "null: there is none"},
    {"reason", "text?", "why there is none"},
    {"end?", "safe|singular", "of a bracket"},
    {"component?", "text", "of a quantity"},
};
constexpr Key kEngineBoxes[] = {
    {"interpreted", "count"},
    {"compiled", "count", "from the request for a compilation on"},
};
constexpr Key kEditedKernel[] = {
    {"path", "text"},
    {"sha256", "sha256"},
};
constexpr Key kFilter[] = {
    {"path", "text"},
    {"name", "text"},
    {"sha256", "sha256"},
    {"boxes", "count", "that rest on it"},
};

constexpr Key kPlace[] = {
    {"parameters", "range{}", "of the motion"},
    {"pose", "enclosure{}"},
    {"uncertain", "range{}"},
};
constexpr Key kPoint[] = {
    {"determinant", "enclosure?", "null: the matrix has more rows than columns"},
    {"exact?", "exact{}", "coordinates that are known exactly and need not be doubles"},
    {"enclosed?", "text[]", "names of what has some value of its range, where rank is lost"},
    {"null_vector?", "enclosure[]", "what the matrix maps to 0 there; one component is 1"},
    {"unknowns?", "enclosure{}", "the configuration of a closure"},
};
constexpr Key kPlaceOfValue[] = {
    {"exact?", "exact{}", "coordinates that are known exactly and need not be doubles"},
    {"segment?", "segment"},
    {"twist?", "approx[]", "with which the speed is attained"},
    {"unknowns?", "enclosure{}", "the configuration of a closure"},
};
constexpr Key kWitnessPoints[] = {
    {"points", "point[]", "two of opposite signs, or one"},
    {"approx_hadamard", "approx?", "the product of the lengths of the rows, for comparison"},
    {"vanishes_within?", "box", "between two points"},
    {"near?", "point", "the point of the smallest determinant"},
};
constexpr Key kDegeneracy[] = {
    {"nullity?", "count?"},
    {"singular_values?", "approx[]?"},
    {"twist?", "lost_twist?"},
    {"rows?", "dependent_rows?"},
};
constexpr Key kBox[] = {{"parameters", "range{}"}, {"uncertain", "range{}"}};
constexpr Key kLostTwist[] = {
    {"approximate", "flag"},
    {"columns", "twist_column[]"},
    {"normalised", "text"},
    {"vectors", "approx[][]"},
};
constexpr Key kTwistColumn[] = {{"column", "count"}, {"name?", "text"}, {"unit?", "text"}};
constexpr Key kRows[] = {
    {"approximate", "flag"},
    {"taking_part", "count[]", "from 1"},
    {"threshold", "approx"},
    {"vectors", "approx[][]"},
};
constexpr Key kBranch[] = {
    {"start", "enclosure{}", "of the motion's parameters"},
    {"unknowns", "enclosure{}", "the configuration there"},
    {"certain", "flag", "false: the numbers of the file, and not the configuration"},
};
constexpr Key kFold[] = {
    {"parameters", "enclosure{}"},
    {"uncertain", "enclosure{}"},
    {"unknowns", "enclosure{}"},
    {"direction", "enclosure{}", "of the unknowns, with the motors locked"},
    {"on_branch", "flag", "configurations of the motion lead to it from the start"},
};
constexpr Key kSolution[] = {
    {"values", "enclosure{}", "by unknown"},
    {"pose?", "enclosure{}", "the same by the model's pose parameters, if the model has angles"},
    {"determinant", "positive|negative|unknown", "its sign"},
    {"condition", "approx?", "in the 2-norm; null: infinite"},
    {"limits", "none|within|beyond|border", "those of the model"},
    {"beyond", "text?", "what is beyond them"},
};
constexpr Key kPlacedNumber[] = {
    {"exact", "exact", "in the unit"}, {"enclosure", "enclosure"}, {"unit", "text"}};
constexpr Key kPlacesFile[] = {
    {"file", "text"}, {"sha256", "sha256"}, {"time_unit", "text", "empty: none is given"}};
constexpr Key kSolvedPlace[] = {
    {"line", "count", "of the file; without one its number, from 1"},
    {"time?", "approx"},
    {"place", "placed_number{}", "the numbers that are given"},
    {"verdict", "complete|none|incomplete"},
    {"claim", "text"},
    {"boxes", "count", "that were evaluated"},
};
constexpr Key kNearest[] = {
    {"approximate", "flag"},
    {"hadamard_share?", "approx", "of what the rows allow: almost singular"},
};
constexpr Key kUndefined[] = {{"expressions", "undefined_expression[]"}};
constexpr Key kExpression[] = {
    {"expression", "text"}, {"argument?", "text"}, {"enclosure?", "enclosure"}};

constexpr Key kShare[] = {{"boxes", "count"}, {"volume", "enclosure"}, {"fraction", "range"}};
constexpr Key kClaimShare[] = {{"boxes", "count"}, {"fraction", "range"}};
constexpr Key kWorkspace[] = {
    {"fraction", "range"},
    {"inside", "share"},
    {"outside", "share"},
    {"undecided", "share"},
};
constexpr Key kWaypoints[] = {
    {"file", "text"}, {"sha256", "sha256"}, {"interpolation", "text"}, {"segments", "count"}};
constexpr Key kSegmentPlace[] = {
    {"segment", "count", "from 1"},
    {"lines", "count[]", "of the file"},
    {"time?", "approx"},
    {"s?", "range", "the place on the segment, from 0 to 1"},
};

constexpr Key kGrowing[] = {
    {"kind", "tolerance|alpha|scale|parameter|tube"},
    {"groups?", "text"},
    {"parameter?", "text"},
    {"parameters?", "text"},
    {"unit", "text?", "of low, high and the ends of the bracket; null: none"},
    {"low", "exact"},
    {"high", "exact?", "null: none"},
};
constexpr Key kStep[] = {
    {"value", "approx"},   {"exact", "exact"}, {"verdict", "text"},   {"reason", "text"},
    {"nonempty", "flag?"}, {"boxes", "count"}, {"seconds", "approx"},
};
constexpr Key kQuantity[] = {
    {"kind", "text", "a quantity of regulus bound, or an expression"},
    {"unit", "text"},
    {"least", "flag"},
    {"signed", "flag"},
    {"norm?", "2|max", "of a condition number"},
    {"components", "text[]"},
    {"load?", "vector_set"},
    {"twist?", "vector_set"},
    {"actuator_errors_exact?", "exact[]"},
    {"stiffness_exact?", "exact[]"},
};
constexpr Key kVectorSet[] = {{"name", "text"}, {"entries", "vector_entry[]"}};
constexpr Key kVectorEntry[] = {
    {"name", "text"},           {"value_exact", "exact"}, {"tolerance_exact?", "exact"},
    {"radius_exact?", "exact"}, {"unit", "text"},
};
constexpr Key kComponent[] = {
    {"label", "text"},
    {"unit", "text"},
    {"verdict?", "within|exceeded|possible-problem"},
    {"attained?", "rounded?"},
    {"proved?", "rounded?"},
    {"attained_exact?", "exact?"},
    {"proved_exact?", "exact?"},
    {"unbounded?", "flag"},
    {"closed?", "flag"},
    {"reason", "text", "why it is not closed or not decided; otherwise empty"},
    {"nonempty", "flag?"},
    {"place", "place_of_value?"},
    {"boxes", "count"},
    {"seconds", "seconds"},
    {"limit?", "kept|EXCEEDED|unknown?", "of a datasheet"},
};
constexpr Key kComponentMargin[] = {
    {"label", "text"},      {"within", "exact?"},         {"exceeded", "exact?"},
    {"closed", "flag"},     {"place", "place_of_value?"}, {"boxes", "count"},
    {"seconds", "seconds"},
};
constexpr Key kForceWitness[] = {
    {"parameters", "range{}"},
    {"uncertain", "range{}"},
    {"unknowns?", "range{}", "of a closure: the configuration"},
    {"motor?", "text", "of a closure: whose force is beyond its limits"},
    {"wrench", "enclosure[]"},
    {"wrench_units", "text[]", "by component"},
    {"direction", "approx[]"},
    {"direction_units", "text[]", "by component"},
    {"needed", "enclosure", "along the direction"},
    {"possible", "enclosure"},
    {"work_unit", "text", "of both"},
};
constexpr Key kEndFiles[] = {{"safe", "text?"}, {"singular", "text?"}};
constexpr Key kEndObstacles[] = {{"safe?", "text"}, {"singular?", "text"}};
constexpr Key kSheetEntry[] = {
    {"boxes", "count"},
    {"seconds", "seconds"},
    {"claim", "text?"},
    {"verdict", "closed|open|refuted|within|exceeded|possible-problem"},
};

/// Of questions, searches and solutions.
std::vector<ObjectKind> kinds_of_parts_of_searches() {
  return {
      {"question",
       "everything that was asked about the model, the motion and with the options of the head: "
       "with these it can be asked again; in a margin the growing quantity has its declared value",
       {kQuestion}},
      {"options", "of the search", {kOptions}},
      {"uncertain_quantity", "a constant or a control error", {kUncertain}},
      {"group", "uncertain quantities of one tolerance", {kGroup}},
      {"seconds", "by stage", {kSeconds}},
      {"proof", "a certificate, or why there is none", {kProof}},
      {"engine_boxes", "how boxes were evaluated", {kEngineBoxes}},
      {"edited_kernel", "the text of a kernel that a person has edited", {kEditedKernel}},
      {"filter", "a filter of the user", {kFilter}},
      {"point", "a pose and its determinant", {kPlace, kPoint}},
      {"place_of_value", "where a value is attained", {kPlace, kPlaceOfValue}},
      {"witness", "a singularity", {kWitnessPoints, kDegeneracy}},
      {"box", "of poses and uncertain values", {kBox}},
      {"lost_twist", "what the actuators do not control", {kLostTwist}},
      {"twist_column", "a column of the matrix", {kTwistColumn}},
      {"dependent_rows", "rows of the matrix, with weights", {kRows}},
      {"nearest_singular", "approximate; proves nothing", {kPlace, kNearest, kDegeneracy}},
      {"branch", "where the branch of a closure starts", {kBranch}},
      {"fold", "a certified singular configuration of a closure", {kFold}},
      {"solution", "a certain solution", {kSolution}},
      {"placed_number", "a number of a place", {kPlacedNumber}},
      {"places_file", "a table of places", {kPlacesFile}},
      {"solved_place", "a place and its solutions", {kSolvedPlace, kSolve}},
      {"undefined", "a pose at which expressions have no value", {kPlace, kUndefined}},
      {"undefined_expression", "over that pose", {kExpression}},
  };
}

/// Of pavings, ways, brackets and loads.
std::vector<ObjectKind> kinds_of_other_parts() {
  return {
      {"share", "of the ranges", {kShare}},
      {"claim_share", "of the ranges", {kClaimShare}},
      {"workspace", "the part of the ranges that meets the constraints", {kWorkspace}},
      {"waypoints", "the file", {kWaypoints}},
      {"segment", "between two way-points", {kSegmentPlace}},
      {"growing", "what grows", {kGrowing}},
      {"step", "a search at one value", {kStep}},
      {"quantity", "what is bounded", {kQuantity}},
      {"vector_set", "a load or a set of twists", {kVectorSet}},
      {"vector_entry", "a member of it", {kVectorEntry}},
      {"component",
       "the bracket of a component, or its comparison with the limit",
       {kComponent, kEndProofs}},
      {"component_margin", "the bracket of a component", {kComponentMargin, kEndProofs}},
      {"sheet_entry", "the bracket of a quantity", {kSheetEntry, kBound}},
      {"force_witness", "a wrench that is not held", {kForceWitness}},
      {"end_files", "of the ends of a bracket", {kEndFiles}},
      {"end_obstacles", "of the ends of a bracket", {kEndObstacles}},
  };
}

}  // namespace

const std::vector<ObjectKind>& object_kinds() {
  static const std::vector<ObjectKind> kinds = [] {
    std::vector<ObjectKind> all = kinds_of_parts_of_searches();
    std::ranges::move(kinds_of_other_parts(), std::back_inserter(all));
    return all;
  }();
  return kinds;
}

}  // namespace regulus::detail
