# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DSOURCE_DIR=… -P include_directions.cmake
# Who may include whom:
#   1. An include is a path of the repository.
#   2. The folders below are floors, from the ground up. A folder includes itself and the lines above its own,
#      so runtime/ never sees codegen/. Folders on one line are siblings, and do not see each other.
#   3. A header of one question that another needs is named here, until it has found a floor of its own.
#   4. The verifier knows of what writes certificates the format alone.
#   5. GiNaC, CLN, LLVM, CLI11, tinyxml2 and JSON stay in the folders that need them.
# A folder inside one that is named here belongs to it. A name may also be that of a header with its source.
cmake_minimum_required(VERSION 3.25)

set(floors
    "runtime/files"
    "runtime/interval"
    "runtime/kernel runtime/regularity runtime/existence"
    "runtime/machine runtime/problem runtime/solutions"
    "runtime/cluster runtime/evaluation"
    "runtime/witness"
    "runtime/search"
    "runtime/embedded"
    "runtime/checkpoint runtime/proof"
    "codegen/support"
    "codegen/answer/key*"
    "codegen/answer/facts"
    "codegen/model"
    "codegen/model/robot codegen/model/import"
    "codegen/kernel/program"
    "codegen/kernel/symbolic codegen/kernel/pack"
    "codegen/kernel/columns"
    "codegen/kernel/formulation"
    "codegen/kernel/cpp"
    "codegen/kernel/jit"
    "codegen/question/engine codegen/question/quantity"
    "codegen/question/analysis"
    "runtime/verifier"
    "runtime/formal"
    "codegen/answer/certificate"
    "codegen/answer/report"
    "codegen/question/margin"
    "codegen/question/way"
    "codegen/question/bound codegen/question/condition codegen/question/load codegen/question/closure"
    "codegen/question/solve/solutions"
    "codegen/question/solve"
    "codegen/answer/picture codegen/answer/page"
    "codegen/answer"
    "codegen/use/api"
    "codegen/use/command"
    "codegen/use/shell codegen/use/mpi codegen/use/python")

# Headers of one question for another, without codegen/question/.
set(lent
    bound/bound_certificate.hpp
    bound/bound_number.hpp
    bound/bound_run.hpp
    bound/limit_margin.hpp
    bound/singular_pose.hpp
    bound/way_place.hpp
    condition/condition_run.hpp
    condition/condition_test.hpp
    condition/rotated_boxes.hpp
    condition/singular_value_test.hpp
    condition/stretched_vectors.hpp
    load/feasibility_report.hpp
    load/feasibility_search.hpp
    load/force_problem.hpp)

# What the verifier and what prints for Coq see.
set(only_runtime/verifier runtime/files/ runtime/proof/format.hpp)
set(only_runtime/formal   runtime/files/ runtime/proof/format.hpp runtime/verifier/)
set(only_runtime/verifier/main.cpp runtime/formal/)  # the program

set(users_of_ginac    codegen/model codegen/model/import codegen/model/robot codegen/kernel/symbolic codegen/answer/certificate codegen/question)
set(users_of_cln      codegen/model codegen/kernel codegen/answer/certificate codegen/question/way)
set(users_of_llvm     codegen/kernel/jit)
set(users_of_CLI11    codegen/use/command)
set(users_of_tinyxml2 codegen/model/import)
set(users_of_JSON     codegen/kernel/cpp codegen/question codegen/answer codegen/use)

# Headers that are configured and carry no layer: the compiler flags, the version.
set(everywhere regulus/floating_point_flags.hpp regulus/instruction_set_flags.hpp regulus/text_flags.hpp regulus/version.hpp)

set(faults "")
macro(fault file text)
  string(APPEND faults "${file}: ${text}\n")
endmacro()

# floor_of_FOLDER for each folder; folders, the longest names first.
set(number 0)
set(folders "")
foreach(floor IN LISTS floors)
  string(REPLACE " " ";" floor "${floor}")
  math(EXPR number "${number} + 1")
  foreach(folder IN LISTS floor)
    set(floor_of_${folder} ${number})
    string(LENGTH "${folder}" length)
    math(EXPR order "1000 - ${length}")
    list(APPEND folders "${order}:${folder}")
  endforeach()
endforeach()
list(SORT folders)
list(TRANSFORM folders REPLACE "^[0-9]+:" "")

# The named folder of a file; empty: none.
function(folder_of file result)
  foreach(folder IN LISTS folders)
    string(REPLACE "*" "[a-z_]*" pattern "${folder}")
    if(file MATCHES "^${pattern}[/.]")
      set(${result} ${folder} PARENT_SCOPE)
      return()
    endif()
  endforeach()
  set(${result} "" PARENT_SCOPE)
endfunction()

function(starts_with_one_of text result)
  set(${result} FALSE PARENT_SCOPE)
  foreach(start IN LISTS ARGN)
    string(FIND "${text}" "${start}" place)
    if(place EQUAL 0)
      set(${result} TRUE PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

macro(check_library file line name pattern)
  if("${line}" MATCHES "${pattern}")
    starts_with_one_of(${file} is_user ${users_of_${name}})
    if(NOT is_user)
      fault(${file} "includes ${name}, allowed in: ${users_of_${name}}")
    endif()
  endif()
endmacro()

macro(check_header file folder header)
  folder_of(${header} included)
  if(NOT EXISTS ${SOURCE_DIR}/${header})
    fault(${file} "includes \"${header}\": expected the path of a header in the repository")
  elseif(DEFINED only_${folder})
    starts_with_one_of(${header} is_known ${only_${folder}} ${folder}/ ${only_${file}})
    if(NOT is_known)
      fault(${file} "includes ${header}, but ${folder} may include only: ${only_${folder}}")
    endif()
  elseif(NOT included)
    fault(${file} "includes ${header}, which is on no floor of tests/layout/include_directions.cmake")
  elseif(NOT included STREQUAL folder AND NOT floor_of_${included} LESS floor_of_${folder})
    string(REPLACE "codegen/question/" "" short ${header})
    if(short IN_LIST lent AND floor_of_${included} EQUAL floor_of_${folder})
      list(APPEND borrowed ${short})
    else()
      fault(${file} "includes ${header}, but ${included} is not below ${folder}")
    endif()
  endif()
endmacro()

# Sources directly in codegen/ are programs: they may include everything.
set(borrowed "")
file(GLOB_RECURSE sources RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/runtime/*.[ch]pp ${SOURCE_DIR}/runtime/*.h
     ${SOURCE_DIR}/codegen/*.[ch]pp ${SOURCE_DIR}/codegen/*.h)
foreach(source IN LISTS sources)
  folder_of(${source} folder)
  if(NOT folder)
    if(NOT source MATCHES "^codegen/[a-z_]+\\.cpp$")
      fault(${source} "is on no floor of tests/layout/include_directions.cmake")
    endif()
    continue()
  endif()
  file(STRINGS ${SOURCE_DIR}/${source} lines REGEX "^[ \t]*#[ \t]*include")
  foreach(line IN LISTS lines)
    check_library(${source} "${line}" ginac "<ginac/")
    check_library(${source} "${line}" cln "<cln/")
    check_library(${source} "${line}" llvm "[<\"](llvm|clang)/")
    check_library(${source} "${line}" CLI11 "<CLI/")
    check_library(${source} "${line}" tinyxml2 "<tinyxml2")
    check_library(${source} "${line}" JSON "<nlohmann/")
    if(line MATCHES "\"([^\"]*)\"" AND NOT CMAKE_MATCH_1 IN_LIST everywhere)
      check_header(${source} ${folder} ${CMAKE_MATCH_1})
    endif()
  endforeach()
endforeach()
foreach(header IN LISTS lent)
  if(NOT header IN_LIST borrowed)
    fault(codegen/question/${header} "is not needed by another question any more: take it from the list here")
  endif()
endforeach()

# Tests name headers in the same way, but for what is made when they are built.
file(GLOB_RECURSE tests RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/tests/*.[ch]pp)
list(FILTER tests EXCLUDE REGEX "^tests/consumer/")
foreach(source IN LISTS tests)
  file(STRINGS ${SOURCE_DIR}/${source} lines REGEX "^#include \"[^\"]*/[^\"]*\"$")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^#include \"([^\"]*)\"$" "\\1" header "${line}")
    if(NOT header IN_LIST everywhere AND NOT EXISTS ${SOURCE_DIR}/${header})
      fault(${source} "includes \"${header}\": expected the path of a header in the repository")
    endif()
  endforeach()
endforeach()

if(faults)
  message(FATAL_ERROR "Include directions broken:\n${faults}")
endif()
