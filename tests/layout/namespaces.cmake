# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DSOURCE_DIR=… -P namespaces.cmake
# Each room of codegen/ has a namespace of its own within regulus, inline, so that programs write
# regulus::Robot: the folder's name, but for three that other names of the project have. In runtime/ it is
# regulus, with a namespace of its own for what must not be mixed up with the rest.
cmake_minimum_required(VERSION 3.25)

set(namespace_pack packing)       # regulus::pack is the arithmetic of kernels
set(namespace_margin bracketing)  # regulus::margin is a function of the interface
set(namespace_bound bounding)     # regulus::bound is a function of the interface
set(namespace_import importing)   # import is a word of the language

set(faults "")
file(GLOB_RECURSE sources RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/codegen/*.[ch]pp ${SOURCE_DIR}/runtime/*.[ch]pp)
list(LENGTH sources count)
if(count LESS 500)
  string(APPEND faults "only ${count} sources were found\n")
endif()
foreach(source IN LISTS sources)
  if(source MATCHES "^runtime/machine/")
    set(expected "regulus::machine")
  elseif(source MATCHES "^runtime/verifier/")
    set(expected "regulus::verifier")
  elseif(source MATCHES "^runtime/")
    set(expected "regulus(::[a-z_]+)?")
  elseif(source MATCHES "^codegen/model/robot/examples/" OR NOT source MATCHES "^codegen/([a-z]+)/")
    set(expected "none: a program has names of its own")
  else()
    set(room ${CMAKE_MATCH_1})
    if(DEFINED namespace_${room})
      set(room ${namespace_${room}})
    endif()
    set(expected "regulus::inline ${room}(::[a-z_]+)?")
  endif()
  file(STRINGS ${SOURCE_DIR}/${source} lines REGEX "^namespace regulus[a-z_: ]* {")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^namespace ${expected} {")
      # A declaration of what another room defines: the name alone, in that room's namespace.
      if(line MATCHES "^namespace regulus::inline [a-z]+ {$" AND source MATCHES "\\.hpp$")
        file(READ ${SOURCE_DIR}/${source} text)
        string(FIND "${text}" "${line}" at)
        string(SUBSTRING "${text}" ${at} 200 text)
        if(text MATCHES "^namespace [a-z: ]+ {\n(class|struct) [A-Za-z]+;\n}")
          continue()
        endif()
      endif()
      string(APPEND faults "${source}: \"${line}\": expected ${expected}\n")
    endif()
  endforeach()
endforeach()
if(faults)
  message(FATAL_ERROR "Namespaces:\n${faults}")
endif()
