# SPDX-License-Identifier: GPL-3.0-or-later
# share/regulus/page.html, the page that `regulus report` fills: TypeScript of codegen/page/web, bundled
# with three.js by esbuild. Packages come from npm at configuration, as package-lock.json pins them. Without
# npm or its packages everything else is built, and `regulus report` says what is missing.
option(REGULUS_PAGE "Build the page of `regulus report`, if npm and its packages are there" ON)
set(REGULUS_PAGE_TEMPLATE "" CACHE INTERNAL "The built page; empty: there is none")
if(NOT REGULUS_PAGE)
  return()
endif()
find_program(REGULUS_NPM npm)
find_program(REGULUS_NODE NAMES node nodejs)
if(NOT REGULUS_NPM OR NOT REGULUS_NODE)
  message(STATUS "npm not found: `regulus report` will be missing its page (Debian: npm)")
  return()
endif()

set(web ${CMAKE_CURRENT_SOURCE_DIR}/web)
set(work ${CMAKE_CURRENT_BINARY_DIR}/web)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${web}/package.json ${web}/package-lock.json)
file(MAKE_DIRECTORY ${work})
file(SHA256 ${web}/package-lock.json wanted)
set(installed "")
if(EXISTS ${work}/installed-lock)
  file(READ ${work}/installed-lock installed)
endif()
if(NOT installed STREQUAL wanted)
  message(STATUS "Getting the packages of the page with npm")
  configure_file(${web}/package.json ${work}/package.json COPYONLY)
  configure_file(${web}/package-lock.json ${work}/package-lock.json COPYONLY)
  configure_file(${web}/.npmrc ${work}/.npmrc COPYONLY)
  execute_process(COMMAND ${REGULUS_NPM} ci --ignore-scripts --fetch-retries=1 --fetch-timeout=60000
                  WORKING_DIRECTORY ${work} TIMEOUT 300
                  RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed)
    string(REGEX MATCHALL "[^\n]+" lines "${output}")
    list(SUBLIST lines 0 6 lines)
    list(JOIN lines "\n  " output)
    message(WARNING "npm could not get the packages of codegen/page/web (${failed}), so `regulus report` will be "
                    "missing its page; everything else is built. Run cmake again with a network.\n  ${output}")
    return()
  endif()
  file(WRITE ${work}/installed-lock ${wanted})
endif()

file(GLOB_RECURSE page_sources CONFIGURE_DEPENDS ${web}/src/* ${web}/build.mjs ${web}/tsconfig.json)
set(page_template ${PROJECT_BINARY_DIR}/share/regulus/page.html)
add_custom_command(
  OUTPUT ${page_template}
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${work}/src
  COMMAND ${CMAKE_COMMAND} -E copy_directory ${web}/src ${work}/src
  COMMAND ${CMAKE_COMMAND} -E copy ${web}/build.mjs ${web}/tsconfig.json ${work}
  COMMAND ${REGULUS_NODE} build.mjs ${page_template}
  WORKING_DIRECTORY ${work}
  DEPENDS ${page_sources} ${web}/package-lock.json
  COMMENT "Building the page of regulus report"
  VERBATIM)
add_custom_target(regulus_page_template ALL DEPENDS ${page_template})
set(REGULUS_PAGE_TEMPLATE ${page_template} CACHE INTERNAL "The built page; empty: there is none")
