# SPDX-License-Identifier: GPL-3.0-or-later
# Writes the pages of the manual side by side into FOLDER.
#   PAGES, PICTURES   files
#   LOOSE             pages that lie elsewhere: PAGE>FILE>PREFIX, where the prefix leads from FILE to FOLDER
#   CMARK             the program cmark-gfm; empty: no HTML
cmake_minimum_required(VERSION 3.25)

# The name of a page in FOLDER; the models' page has the name of the first page.
function(page_name page result)
  get_filename_component(name ${page} NAME)
  if(page MATCHES "models/README.md$")
    set(name MODELS.md)
  endif()
  set(${result} ${name} PARENT_SCOPE)
endfunction()

# Gives each heading the name that links to it use, as GitHub does.
function(name_headings html result)
  string(REGEX MATCHALL "<h[1-4]>[^\n]*</h[1-4]>" headings "${html}")
  foreach(heading IN LISTS headings)
    string(REGEX REPLACE "<[^>]*>" "" name "${heading}")
    string(TOLOWER "${name}" name)
    string(REGEX REPLACE "[^a-z0-9_ -]" "" name "${name}")
    string(REPLACE " " "-" name "${name}")
    string(REGEX REPLACE "^<(h[1-4])>" "<\\1 id=\"${name}\">" named "${heading}")
    string(REPLACE "${heading}" "${named}" html "${html}")
  endforeach()
  set(${result} "${html}" PARENT_SCOPE)
endfunction()

# A link to another page or picture loses its folders, and gets the prefix; one with a scheme has a colon, and
# is left alone.
function(relink text prefix result)
  string(REPLACE "](models/README.md)" "](MODELS.md)" text "${text}")
  string(REGEX REPLACE "\\]\\([^]):#[ ]*/([^]):#/[ ]+\\.(md|svg|webp))" "](\\1" text "${text}")
  if(prefix)
    string(REGEX REPLACE "\\]\\(([^]):#/[ ]+\\.(md|svg|webp))" "](${prefix}\\1" text "${text}")
  endif()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

set(style "body{max-width:60rem;margin:2rem auto;padding:0 1rem;font:16px/1.5 sans-serif;color:#1b1f24;background:#fff}
pre{background:#f4f5f7;padding:.8rem;overflow-x:auto}code{font-size:90%}
table{border-collapse:collapse}td,th{border:1px solid #c9ced6;padding:.3rem .6rem;text-align:left;vertical-align:top}
.wide{overflow-x:auto}p,li,h1,h2,h3{overflow-wrap:anywhere}
img{max-width:100%}
@media(prefers-color-scheme:dark){body{color:#dde1e7;background:#16181d}pre{background:#22252c}a{color:#8ab4ff}}")

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
file(COPY ${PICTURES} DESTINATION ${FOLDER})
foreach(page IN LISTS PAGES)
  page_name(${page} name)
  file(READ ${page} text)
  relink("${text}" "" text)
  file(WRITE ${FOLDER}/${name} "${text}")
  if(NOT CMARK)
    continue()
  endif()
  execute_process(COMMAND ${CMARK} --extension table ${FOLDER}/${name} OUTPUT_VARIABLE html COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE "href=\"([A-Za-z_]+)\\.md" "href=\"\\1.html" html "${html}")
  name_headings("${html}" html)
  # On a narrow screen a table scrolls, and the page does not.
  string(REPLACE "<table>" "<div class=\"wide\" tabindex=\"0\"><table>" html "${html}")
  string(REPLACE "</table>" "</table></div>" html "${html}")
  string(REGEX MATCH "^# ([^\n]*)" title "${text}")
  set(title "${CMAKE_MATCH_1}")
  get_filename_component(stem ${name} NAME_WE)
  file(WRITE ${FOLDER}/${stem}.html
       "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">\n"
       "<title>${title}</title>\n<style>${style}</style></head><body>\n"
       "<p><a href=\"README.html\">Regulus: the manual</a></p>\n${html}</body></html>\n")
endforeach()

foreach(loose IN LISTS LOOSE)
  string(REPLACE ">" ";" loose "${loose}")
  list(GET loose 0 page)
  list(GET loose 1 file)
  list(GET loose 2 prefix)
  file(READ ${page} text)
  relink("${text}" "${prefix}" text)
  file(WRITE ${file} "${text}")
endforeach()
