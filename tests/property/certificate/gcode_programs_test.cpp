// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/certificate/gcode_programs.hpp"

namespace regulus::test {
namespace {

TEST_F(GcodePrograms, AreReadAsAMachineMovesOrRefusedByBothReaders) { read_programs(0, 1500); }

}  // namespace
}  // namespace regulus::test
