// SPDX-License-Identifier: GPL-3.0-or-later
// Keys that reports share with objects within reports.
#pragma once

#include "codegen/answer/keys.hpp"

namespace regulus::detail {

inline constexpr Key kEndProofs[] = {
    {"certificates?", "end_files", "the file of each end, or null"},
    {"certificate_obstacles?", "end_obstacles", "why an end has none"},
};

inline constexpr Key kBound[] = {
    {"bound", "text", "the quantity"},
    {"result", "text", "the bracket in words"},
    {"quantity", "quantity"},
    {"least", "flag", "the least value is bounded, not the largest"},
    {"unit", "text"},
    {"waypoints?", "waypoints"},
    {"limit?", "exact", "the limit to compare with; without it there is a bracket"},
    {"attained?", "rounded?", "some pose has this value"},
    {"attained_by?", "text?", "the component that has it"},
    {"proved?", "rounded?", "no pose has a value beyond"},
    {"gap?", "approx?", "relative to the larger end"},
    {"gap_wanted?", "approx"},
    {"closed?", "flag", "the bracket is as narrow as wanted"},
    {"components", "component[]"},
};

inline constexpr Key kSolve[] = {
    {"solutions", "solution[]", "pairwise different"},
    {"open_boxes", "enclosure{}[]", "that may hold others"},
    {"complex_solutions", "count?", "of a count: those that were certified"},
    {"how", "text?", "completeness is shown; null: it is not"},
    {"obstacle", "text?", "why completeness is not shown"},
    {"stopped_by", "text?", "the limit that ended the search"},
};

}  // namespace regulus::detail
