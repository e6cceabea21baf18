# SPDX-License-Identifier: GPL-3.0-or-later
# The check refuses what is false, and accepts what is true next to it.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
foreach(file IN ITEMS Existence ClosureRefusals LimitRefusals PavingRefusals RateRefusals SlopeRefusals DistanceRefusals
        SolutionRefusals SpectrumRefusals PoseRefusals WayRefusals)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/${file}.v ${WORK_DIR}/${file}.v COPYONLY)
  run_coq(code text ${file}.v)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${file}.v\n${text}")
  endif()
endforeach()
configure_file(${CMAKE_CURRENT_LIST_DIR}/Refusals.v ${WORK_DIR}/Refusals.v COPYONLY)
run_coq(code text Refusals.v)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "${text}")
endif()
