# SPDX-License-Identifier: GPL-3.0-or-later
# share/regulus/page.html, the page that `regulus report` fills: TypeScript of codegen/answer/page/web, bundled
# with three.js by esbuild. When it is built, packages come from npm, as package-lock.json pins them. Without
# npm or its packages everything else is built, and `regulus report` says what is missing.
option(REGULUS_PAGE "Build the page of `regulus report`, if npm and its packages are there" ON)
set(REGULUS_PAGE_TEMPLATE "" CACHE INTERNAL "The page; empty: it is not built")
if(NOT REGULUS_PAGE)
  return()
endif()
find_program(REGULUS_NPM npm)
find_program(REGULUS_NODE NAMES node nodejs)
if(NOT REGULUS_NPM OR NOT REGULUS_NODE)
  message(STATUS "npm not found: `regulus report` will be missing its page (Debian: npm)")
  return()
endif()

# regulus_npm_packages(TARGET FOLDER WORK): the packages of FOLDER/package-lock.json, in WORK. When there is no
# installed-lock in WORK, npm could not get them; it tries again after the next run of cmake.
function(regulus_npm_packages target folder work)
  file(REMOVE ${work}/refused-lock)
  add_custom_command(
    OUTPUT ${work}/tried
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${folder} -DWORK=${work} -DNPM=${REGULUS_NPM}
            -P ${PROJECT_SOURCE_DIR}/cmake/get_npm_packages.cmake
    DEPENDS ${folder}/package.json ${folder}/package-lock.json ${folder}/.npmrc
    VERBATIM)
  add_custom_target(${target} ALL DEPENDS ${work}/tried)
endfunction()

set(web ${CMAKE_CURRENT_SOURCE_DIR}/web)
set(work ${CMAKE_CURRENT_BINARY_DIR}/web)
set(REGULUS_PAGE_WORK ${work} CACHE INTERNAL "The folder with the packages of the page")
set(REGULUS_PAGE_TEMPLATE ${PROJECT_BINARY_DIR}/share/regulus/page.html CACHE INTERNAL "The page; empty: it is not built")
regulus_npm_packages(regulus_page_packages ${web} ${work})

file(GLOB_RECURSE page_sources CONFIGURE_DEPENDS ${web}/src/* ${web}/build.mjs ${web}/tsconfig.json)
# Made from the table of keys.
set(types ${PROJECT_BINARY_DIR}/codegen/answer/report_types.ts)
add_custom_command(
  OUTPUT ${REGULUS_PAGE_TEMPLATE}
  COMMAND ${CMAKE_COMMAND} -DFOLDER=${web} -DWORK=${work} -DNODE=${REGULUS_NODE} -DPAGE=${REGULUS_PAGE_TEMPLATE} -DTYPES=${types}
          -P ${PROJECT_SOURCE_DIR}/cmake/build_page.cmake
  DEPENDS ${page_sources} ${work}/tried ${types} regulus_schema
  COMMENT "Building the page of regulus report"
  VERBATIM)
add_custom_target(regulus_page_template ALL DEPENDS ${REGULUS_PAGE_TEMPLATE})
add_dependencies(regulus_page_template regulus_page_packages)
