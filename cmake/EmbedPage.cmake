# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
# embed_page(SOURCE HEADER report/internal/web_assets.h NAMESPACE stucco::internal
#            STYLES a.css ... SCRIPTS a.js ...)
# A page's style sheets and scripts become one source file, so that the program carries them; its
# path is put into SOURCE. The header declares PageStyle() and PageScript().
function(embed_page variable)
  cmake_parse_arguments(P "" "HEADER;NAMESPACE" "STYLES;SCRIPTS" ${ARGN})
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_page.cmake)
  list(JOIN P_STYLES "," styles)
  list(JOIN P_SCRIPTS "," scripts)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/web_assets.cpp)
  add_custom_command(OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -DOUT=${source} -DSTYLES=${styles} -DSCRIPTS=${scripts}
      -DHEADER=${P_HEADER} -DNAMESPACE=${P_NAMESPACE} -P ${script}
    DEPENDS ${P_STYLES} ${P_SCRIPTS} ${script}
    COMMENT "Embedding the page of ${P_HEADER}" VERBATIM)
  set(${variable} ${source} PARENT_SCOPE)
endfunction()
