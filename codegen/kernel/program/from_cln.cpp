// SPDX-License-Identifier: GPL-3.0-or-later
// Converts from CLN: the results do not use CLN and may be given to any thread.
#include <cln/integer.h>
#include <cln/integer_io.h>
#include <cln/rational.h>
#include <fmpz.h>

#include <sstream>

#include "codegen/kernel/program/ball_program.hpp"
#include "codegen/kernel/program/program.hpp"

namespace regulus::detail {
namespace {

void assign(fmpz_t to, const cln::cl_I& value) {
  std::ostringstream digits;
  cln::print_integer(digits, 16U, value);
  fmpz_set_str(to, digits.str().c_str(), 16);
}

}  // namespace

FlintRational::FlintRational(const cln::cl_RA& value) : FlintRational() {
  assign(fmpq_numref(value_), cln::numerator(value));
  assign(fmpq_denref(value_), cln::denominator(value));
}

Ball::Ball(const cln::cl_RA& value, long precision) : Ball(FlintRational(value), precision) {}

BallProgram::BallProgram(const Program& program)
    : nodes(program.nodes),
      constants(program.constants.begin(), program.constants.end()),
      inputs(program.inputs.size()),
      outputs(program.outputs) {
  if (!program.points.empty()) throw std::invalid_argument("a program that reads entries of K");
}

}  // namespace regulus::detail
