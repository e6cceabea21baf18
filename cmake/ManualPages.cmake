# SPDX-License-Identifier: GPL-3.0-or-later
# share/doc/regulus/manual: the manual as Markdown, and as HTML if cmark-gfm is there. The pages lie side by
# side, and their links say so. cmark-gfm is small, and knows the tables that the pages have.
set(REGULUS_MANUAL_PAGES
    README.md DEVELOPING.md models/README.md models/DATASHEETS.md codegen/EMBEDDING.md codegen/answer/WHAT_WORKS.md codegen/answer/REPORTS.md codegen/use/TUTORIAL.md codegen/use/VERSIONS.md codegen/use/command/METHODS.md codegen/question/bound/BOUNDS.md codegen/question/solve/SOLVING.md codegen/use/command/CHECKING.md
    codegen/model/import/IMPORTING.md codegen/model/MODEL_FILES.md codegen/use/mpi/CLUSTER.md codegen/answer/page/PAGES.md
    codegen/use/python/PYTHON.md codegen/model/robot/AUTHORS.md codegen/use/shell/SHELL.md runtime/PERFORMANCE.md
    runtime/SOUNDNESS.md runtime/proof/CERTIFICATES.md runtime/proof/FORMAT.md
    runtime/proof/PROOF.md runtime/formal/FORMAL.md)
set(REGULUS_MANUAL_PICTURES
    codegen/answer/page/page.webp codegen/answer/page/robots.webp codegen/answer/page/slices.webp codegen/answer/page/solutions.webp codegen/answer/page/way.webp
    models/planar_3rpr.svg models/tsai_3upu.svg tests/paper/growth.svg)

find_program(REGULUS_CMARK cmark-gfm)
if(NOT REGULUS_CMARK)
  message(STATUS "cmark-gfm not found: the manual will be installed as Markdown only")
endif()

set(manual ${PROJECT_BINARY_DIR}/share/doc/regulus/manual)
set(script ${CMAKE_CURRENT_LIST_DIR}/write_manual_pages.cmake)
list(TRANSFORM REGULUS_MANUAL_PAGES PREPEND ${PROJECT_SOURCE_DIR}/ OUTPUT_VARIABLE sources)
list(TRANSFORM REGULUS_MANUAL_PICTURES PREPEND ${PROJECT_SOURCE_DIR}/ OUTPUT_VARIABLE pictures)
# Pages beside the manual, and in other packages.
set(loose
    "${PROJECT_SOURCE_DIR}/README.md>${manual}/../README.md>manual/"
    "${PROJECT_SOURCE_DIR}/codegen/use/mpi/CLUSTER.md>${manual}/../../regulus-mpi/CLUSTER.md>../regulus/manual/"
    "${PROJECT_SOURCE_DIR}/codegen/use/python/PYTHON.md>${manual}/../../python3-regulus/PYTHON.md>../regulus/manual/")
add_custom_command(
  OUTPUT ${manual}/README.md
  COMMAND ${CMAKE_COMMAND} "-DPAGES=${sources}" "-DPICTURES=${pictures}" "-DLOOSE=${loose}" -DFOLDER=${manual} "-DCMARK=$<$<BOOL:${REGULUS_CMARK}>:${REGULUS_CMARK}>"
          -P ${script}
  DEPENDS ${sources} ${pictures} ${script}
  COMMENT "Writing the pages of the manual"
  VERBATIM)
add_custom_target(regulus_manual_pages ALL DEPENDS ${manual}/README.md)
install(FILES ${manual}/../README.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/regulus COMPONENT codegen)
install(DIRECTORY ${manual} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/regulus COMPONENT codegen)
