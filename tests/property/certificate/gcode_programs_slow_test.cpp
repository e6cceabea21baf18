// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/certificate/gcode_programs.hpp"

namespace regulus::detail::test {
namespace {

TEST_F(GcodePrograms, AreReadAsAMachineMovesOrRefusedByBothReaders) { read_programs(1500, 8'500); }

}  // namespace
}  // namespace regulus::detail::test
