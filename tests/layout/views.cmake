# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DSOURCE_DIR=… -P views.cmake
# The headers of runtime/regularity take matrices and vectors as views, whose types tell points from
# intervals and matrices from vectors: none has a pointer to double. Exempt are the views themselves,
# the memory that they look at, and the loops that backend_*.cpp compile.
cmake_minimum_required(VERSION 3.25)
set(faults "")
file(GLOB headers RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/runtime/regularity/*.hpp)
list(LENGTH headers count)
if(count LESS 10)
  string(APPEND faults "runtime/regularity: only ${count} headers were found\n")
endif()
list(FILTER headers EXCLUDE REGEX "(_lanes|/views|/aligned_buffer)\\.hpp$")
foreach(header IN LISTS headers)
  file(STRINGS ${SOURCE_DIR}/${header} lines REGEX "double( const)?[ ]*[*]")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^ *//")
      string(APPEND faults "${header}: expected a view of runtime/regularity/views.hpp in: ${line}\n")
    endif()
  endforeach()
endforeach()
if(faults)
  message(FATAL_ERROR "Pointers to double in public headers:\n${faults}")
endif()
