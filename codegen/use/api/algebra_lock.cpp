// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/api/algebra_lock.hpp"

namespace regulus::detail {
namespace {

std::recursive_mutex& mutex_of_the_process() {
  static std::recursive_mutex mutex;
  return mutex;
}

}  // namespace

AlgebraLock::AlgebraLock() : lock_(mutex_of_the_process()) {}

}  // namespace regulus::detail
