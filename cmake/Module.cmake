# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Warnings live on one interface target; every module and test links it.
add_library(project_warnings INTERFACE)
target_compile_options(project_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<BOOL:${STUCCO_WERROR}>:-Werror>)
# What GCC 12 concludes from inlined code about memory is wrong in places, in Eigen's asserts and in
# its own strings (bugs 105329, 105651); ours is checked by tests.
target_compile_options(project_warnings INTERFACE
  -Wno-maybe-uninitialized -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds
  -Wno-restrict)
# Sources that are compiled as one (scripts/build.sh) share their names without meaning to:
# nobody who reads one has the others in sight.
if(CMAKE_UNITY_BUILD)
  target_compile_options(project_warnings INTERFACE -Wno-shadow)
endif()
# A product and a sum are never merged into one rounding, so that our own sums are the same at every
# optimisation level. Libraries that choose their code by processor, such as OpenCV, may still give
# other digits on another machine.
add_compile_options(-ffp-contract=off)

if(STUCCO_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

# At most one CGAL-sized compile at a time on small machines.
set_property(GLOBAL PROPERTY JOB_POOLS heavy=1 link=2)
set(CMAKE_JOB_POOL_LINK link)

# add_module(calib [HEAVY] HEADERS ... SOURCES ... PUBLIC survey PRIVATE Ceres::ceres)
# One static library per folder, exported as stucco::<name>.
function(add_module name)
  cmake_parse_arguments(M "HEAVY" "" "HEADERS;SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(${name} STATIC ${M_SOURCES})
  add_library(stucco::${name} ALIAS ${name})
  target_sources(${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${M_HEADERS})
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_link_libraries(${name} PUBLIC ${M_PUBLIC}
    PRIVATE ${M_PRIVATE} $<BUILD_INTERFACE:project_warnings>)
  set_target_properties(${name} PROPERTIES OUTPUT_NAME stucco_${name})
  use_precompiled(${name} code ${M_PUBLIC} ${M_PRIVATE})
  if(M_HEAVY)
    set_target_properties(${name} PROPERTIES JOB_POOL_COMPILE heavy)
  endif()
  set_property(GLOBAL APPEND PROPERTY STUCCO_MODULES ${name})
endfunction()

# add_module_test(calib SOURCES adjust_test.cpp ... LINK test_support TOGETHER SlowToSetUp)
# One executable per module: fewer links, one line per test in ctest. The library of the module's
# name is linked where there is one; `pipeline` has several, which are named in LINK. The tests of
# the suites in TOGETHER run in one process and are one line: what they share is made once, and
# many short ones do not load their libraries each.
function(add_module_test name)
  cmake_parse_arguments(T "" "" "SOURCES;LINK;TOGETHER" ${ARGN})
  add_executable(${name}_test ${T_SOURCES} ${PROJECT_SOURCE_DIR}/tests/main.cpp)
  target_link_libraries(${name}_test
    PRIVATE $<TARGET_NAME_IF_EXISTS:${name}> ${T_LINK} project_warnings GTest::gmock GTest::gtest)
  target_include_directories(${name}_test PRIVATE ${PROJECT_SOURCE_DIR})
  use_precompiled(${name}_test test ${T_LINK})
  list(TRANSFORM T_TOGETHER APPEND ".*" OUTPUT_VARIABLE together)
  list(JOIN together ":" together)
  gtest_discover_tests(${name}_test TEST_PREFIX ${name}/ TEST_FILTER "*-${together}"
    DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
  foreach(suite ${T_TOGETHER})
    add_test(NAME ${name}/${suite} COMMAND ${name}_test "--gtest_filter=${suite}.*")
    # Before single tests: what is long must not begin last.
    set_tests_properties(${name}/${suite} PROPERTIES TIMEOUT 600 COST 10)
  endforeach()
endfunction()
