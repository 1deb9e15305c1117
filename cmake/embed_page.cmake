# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DOUT=file.cpp -DSTYLES=a.css,b.css -DSCRIPTS=a.js,b.js
#   -DHEADER=report/internal/web_assets.h -DNAMESPACE=stucco::internal -P embed_page.cmake
# Writes a source file with the texts of a page, for the header that declares PageStyle() and
# PageScript(). The licence lines stay in the files and not in every page.
function(joined_text variable files)
  string(REPLACE "," ";" files "${files}")
  set(all "")
  foreach(file ${files})
    file(READ "${file}" text)
    string(REGEX REPLACE "^/\\* SPDX[^\n]*\n[^\n]*\\*/\n" "" text "${text}")
    string(APPEND all "${text}")
  endforeach()
  string(FIND "${all}" ")web\"" delimiter)
  string(FIND "${all}" "</script" end_of_script)
  if(NOT delimiter EQUAL -1 OR NOT end_of_script EQUAL -1)
    message(FATAL_ERROR "a file of the page would end its own literal or <script>")
  endif()
  set(${variable} "${all}" PARENT_SCOPE)
endfunction()

joined_text(style "${STYLES}")
joined_text(script "${SCRIPTS}")
file(WRITE "${OUT}" "// Made by cmake/embed_page.cmake.\n"
  "#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\n\n"
  "std::string_view PageStyle() {\n  return R\"web(${style})web\";\n}\n\n"
  "std::string_view PageScript() {\n  return R\"web(${script})web\";\n}\n\n"
  "}  // namespace ${NAMESPACE}\n")
