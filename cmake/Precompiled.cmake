# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Reading headers is most of the work of a build: most units read Eigen and a dozen standard
# headers, tests GTest too. They are compiled once and shared by all targets; every unit
# still includes what it needs, which scripts/tidy.sh holds as it compiles without them.
# CMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without.
set(precompiled_headers
  <algorithm> <array> <chrono> <cmath> <filesystem> <functional> <map> <optional> <ranges> <set>
  <span> <sstream> <string> <vector> <Eigen/Geometry>)

# A precompiled header serves only units compiled with the same options, so there is one for code
# and one for tests, each also for users of CGAL, which rounds as it needs (-frounding-math).
function(add_precompiled name)
  cmake_parse_arguments(P "" "" "HEADERS;LINK" ${ARGN})
  file(CONFIGURE OUTPUT ${name}.cpp CONTENT "")
  add_library(${name} OBJECT EXCLUDE_FROM_ALL ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_link_libraries(${name} PRIVATE project_warnings Eigen3::Eigen ${P_LINK})
  target_precompile_headers(${name} PRIVATE ${precompiled_headers} ${P_HEADERS})
  # ccache goes by this instead of the compiled bytes (CCACHE_PCH_EXTSUM, set by scripts/build.sh),
  # which are never the same twice: so that a second checkout finds what the first compiled.
  file(WRITE ${CMAKE_BINARY_DIR}/CMakeFiles/${name}.dir/cmake_pch.hxx.gch.sum
    "${precompiled_headers} ${P_HEADERS} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_BUILD_TYPE} "
    "${Eigen3_VERSION} ${GTest_VERSION}")
endfunction()
add_precompiled(precompiled_code)
add_precompiled(precompiled_code_cgal LINK CGAL::CGAL)
if(BUILD_TESTING)
  add_precompiled(precompiled_test HEADERS <gmock/gmock.h> <gtest/gtest.h> LINK GTest::gmock)
  add_precompiled(precompiled_test_cgal HEADERS <gmock/gmock.h> <gtest/gtest.h>
    LINK GTest::gmock CGAL::CGAL)
endif()

# use_precompiled(calib code Eigen3::Eigen CGAL::CGAL ...): `kind` is code or test; then what the
# target links itself.
function(use_precompiled target kind)
  set(cgal "")
  if(CGAL::CGAL IN_LIST ARGN)
    set(cgal _cgal)
  endif()
  target_precompile_headers(${target} REUSE_FROM precompiled_${kind}${cgal})
  target_compile_options(${target} PRIVATE -fpch-preprocess) # which ccache asks for
endfunction()

# Sources whose inner loops become vector instructions at -O3 only. They do without the precompiled
# header: it would bring its own level to functions that are compiled for a processor of their own.
function(optimise_inner_loops)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "-O3" SKIP_PRECOMPILE_HEADERS ON)
endfunction()
