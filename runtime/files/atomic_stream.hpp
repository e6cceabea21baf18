// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <ostream>
#include <streambuf>
#include <string>
#include <vector>

#include "runtime/files/atomic_file.hpp"

namespace regulus::detail {

/// A stream into an AtomicFile.
class AtomicStream : public std::ostream {
 public:
  /// Throws    as AtomicFile.
  explicit AtomicStream(const std::string& name);

  /// Throws    std::system_error, also for what could not be written before.
  void put_in_place();

 private:
  class Buffer : public std::streambuf {
   public:
    explicit Buffer(const std::string& name);

    AtomicFile file;
    std::exception_ptr failure;  ///< the first one: a stream has only a bit for it

   private:
    int_type overflow(int_type next) override;
    int sync() override;

    std::vector<char> part_;
  };

  Buffer buffer_;
};

}  // namespace regulus::detail
