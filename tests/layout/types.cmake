# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DSOURCE_DIR=… -P types.cmake
# A type has one definition: two of one name in one namespace share what the compiler makes of them, as
# destructors, and the linker takes either. Types of anonymous namespaces are their file's own.
cmake_minimum_required(VERSION 3.25)

# The packs have the same names in each instruction set, and no program has both.
set(alike "regulus::pack::I" "regulus::pack::P")

set(faults "")
set(count 0)
file(GLOB_RECURSE sources RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/codegen/*.[ch]pp ${SOURCE_DIR}/runtime/*.[ch]pp)
list(SORT sources)
foreach(source IN LISTS sources)
  file(STRINGS ${SOURCE_DIR}/${source} lines REGEX
       "^(inline )?namespace |^}.*// namespace|^(struct|class|union|enum|enum class) .*{")
  set(spaces "")
  foreach(line IN LISTS lines)
    if(line MATCHES "^(inline )?namespace ([a-z0-9_:]*) ?{")
      list(APPEND spaces "${CMAKE_MATCH_2}:")
    elseif(line MATCHES "^}")
      list(POP_BACK spaces)
    elseif(line MATCHES "^(struct|class|union|enum class|enum) (\\[\\[[a-z]+\\]\\] )?([A-Za-z0-9_]+)( final)?( : .*)? {")
      string(JOIN ":" name ${spaces} "${CMAKE_MATCH_3}")
      if("${name}" MATCHES "^regulus" AND NOT "${name}" MATCHES "::::|:::$" AND NOT ":" IN_LIST spaces)
        math(EXPR count "${count} + 1")
        if(DEFINED "at_${name}" AND NOT "${at_${name}}" STREQUAL source AND NOT name IN_LIST alike)
          string(APPEND faults "${name}: ${at_${name}} and ${source}\n")
        endif()
        set("at_${name}" ${source})
      endif()
    endif()
  endforeach()
endforeach()
if(count LESS 500)
  string(APPEND faults "only ${count} types were found\n")
endif()
if(faults)
  message(FATAL_ERROR "Types with more than one definition:\n${faults}")
endif()
message(STATUS "${count} types")
