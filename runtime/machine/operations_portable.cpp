// SPDX-License-Identifier: Apache-2.0
#define REGULUS_MACHINE_TABLE step_table_portable
#include "runtime/machine/operations.hpp"
