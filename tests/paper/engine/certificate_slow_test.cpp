// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/paper/engine/certificate_cells.hpp"

namespace regulus::detail::test {
namespace {

class CertificatesOfLongTables : public testing::TestWithParam<TableCell> {};

TEST_P(CertificatesOfLongTables, AreVerified) { expect_verified(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Paper, CertificatesOfLongTables,
                         testing::ValuesIn(cells_of(kFewBoxes + 1, 60000)), cell_name);

}  // namespace
}  // namespace regulus::detail::test
