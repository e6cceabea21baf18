// SPDX-License-Identifier: GPL-3.0-or-later
// The interface of Regulus for C++ programs.
//
//   Robot     a robot, its motions and its uncertain quantities, written in C++
//   Question  a robot or a model file, one of its motions, and changes to them
//   check     proves that the motion has no singular pose, or shows one: a Finding
//   locate    paves the motion with boxes that are free, singular or undecided
//   margin    brackets the largest tolerance, threshold or size that is safe
//   bound     brackets the largest or least force, error or speed, or compares it with a limit
//   check_load, locate_load  the same about a load: do forces within the limits hold it?
//   solve     finds all configurations, poses or postures at one place, and proves that these are all
//   verify    proves a certificate again
//   write_page  shows an answer in a browser
//   PreparedQuestion  a question that is asked again with other ranges and tolerances
//   Kernel    compiled functions of a question, for checks of pieces of the motion in a loop
//
// Link Regulus::jit. Errors are InputError, UsageError, FileError, CompileError and InternalError; a time
// limit or an interrupt during the reading of a model is ReadingStopped.
#pragma once

#include "codegen/model/robot/robot.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/use/api/bound.hpp"
#include "codegen/use/api/check.hpp"
#include "codegen/use/api/files.hpp"
#include "codegen/use/api/kernel.hpp"
#include "codegen/use/api/load.hpp"
#include "codegen/use/api/locate.hpp"
#include "codegen/use/api/margin.hpp"
#include "codegen/use/api/page.hpp"
#include "codegen/use/api/prepared_question.hpp"
#include "codegen/use/api/question.hpp"
#include "codegen/use/api/solve.hpp"
