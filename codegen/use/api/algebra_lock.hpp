// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mutex>

namespace regulus::detail {

/// Hold it for any work with objects of GiNaC and CLN in this folder: they count references without
/// locks, and some of them belong to the whole process. A thread may hold it more than once,
/// because a callback may ask another question.
class AlgebraLock {
 public:
  AlgebraLock();

 private:
  std::unique_lock<std::recursive_mutex> lock_;
};

}  // namespace regulus::detail
