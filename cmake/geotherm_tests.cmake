# SPDX-License-Identifier: MIT
# How tests reach ctest. Several build trees (release, asan, tsan) may run in one ctest,
# so each gives its tests a prefix and a label of its own.
include(GoogleTest)

set(GEOTHERM_TEST_SUITE "" CACHE STRING "Prefix and label of this build tree's tests")
set(GEOTHERM_TEST_FILTER "" CACHE STRING "GoogleTest filter: which tests this build tree has")

set(GEOTHERM_TEST_PREFIX "")
set(GEOTHERM_TEST_LABEL release)
if(GEOTHERM_TEST_SUITE)
  set(GEOTHERM_TEST_PREFIX "${GEOTHERM_TEST_SUITE}.")
  set(GEOTHERM_TEST_LABEL ${GEOTHERM_TEST_SUITE})
endif()

# One BLAS thread keeps `ctest -j` honest, and a library that is not instrumented out of the thread
# sanitizer's sight.
# hwloc, which MPI asks for the machine, must not open displays: one that another test ends takes
# the process with it.
set(GEOTHERM_TEST_ENVIRONMENT "OPENBLAS_NUM_THREADS=1" "OMP_NUM_THREADS=1" "HWLOC_COMPONENTS=-gl")
if("thread" IN_LIST GEOTHERM_SANITIZE)
  list(APPEND GEOTHERM_TEST_ENVIRONMENT
       "TSAN_OPTIONS=halt_on_error=1:suppressions=${PROJECT_SOURCE_DIR}/tests/tsan.supp")
elseif("address" IN_LIST GEOTHERM_SANITIZE)
  list(APPEND GEOTHERM_TEST_ENVIRONMENT
       "ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1"
       "UBSAN_OPTIONS=print_stacktrace=1")
endif()

# Under a sanitizer a process takes longer to start than most tests take to run.
set(GEOTHERM_TEST_SHARDS 0)
if(GEOTHERM_SANITIZE)
  set(GEOTHERM_TEST_SHARDS 8)
endif()

# geotherm_discover_tests(TARGET [ENVIRONMENT VARIABLE=VALUE...]): every TEST of the executable becomes
# a test of ctest, and so does every suite of parameterised tests, but for slow ones, which are
# tests each: most of these take less than a process takes to start. Where there are shards, a few
# processes share all tests out.
function(geotherm_discover_tests target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" ENVIRONMENT)
  if(GEOTHERM_TEST_SHARDS)
    math(EXPR last "${GEOTHERM_TEST_SHARDS} - 1")
    foreach(shard RANGE ${last})
      geotherm_add_test(${target}.${shard} $<TARGET_FILE:${target}> --gtest_brief=1
        "--gtest_filter=${GEOTHERM_TEST_FILTER}"
        ENVIRONMENT ${arg_ENVIRONMENT} "GTEST_TOTAL_SHARDS=${GEOTHERM_TEST_SHARDS}"
                    "GTEST_SHARD_INDEX=${shard}")
    endforeach()
    return()
  endif()
  set(environment ${GEOTHERM_TEST_ENVIRONMENT} ${arg_ENVIRONMENT})
  if(GEOTHERM_TEST_FILTER)
    geotherm_discover_single(${target} ${target}_chosen "${GEOTHERM_TEST_FILTER}" "${environment}")
    return()
  endif()
  geotherm_discover_single(${target} ${target}_plain "-*/*" "${environment}")
  geotherm_discover_single(${target} ${target}_slow "*/*Slow*:*Slow*/*" "${environment}")
  set(file "${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake")
  if(NOT EXISTS "${file}")
    file(WRITE "${file}" "")  # until the program is built; its single tests say that it is not
  endif()
  add_custom_command(TARGET ${target} POST_BUILD BYPRODUCTS "${file}" VERBATIM
    COMMAND "${CMAKE_COMMAND}" -D "PROGRAM=$<TARGET_FILE:${target}>" -D "FILE=${file}"
            -D "LABEL=${GEOTHERM_TEST_LABEL}" -D "ENVIRONMENT=${environment}"
            -D "FILTER=*/*-*Slow*" -P "${PROJECT_SOURCE_DIR}/cmake/discover_suites.cmake")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${file}")
endfunction()

# The tests of an executable that a filter names, each of them a test of ctest; `list`: a variable of
# ctest that holds their names.
function(geotherm_discover_single target list filter environment)
  gtest_discover_tests(${target} TEST_PREFIX "${GEOTHERM_TEST_PREFIX}" TEST_FILTER "${filter}"
    NO_PRETTY_VALUES TEST_LIST ${list} DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 300 LABELS ${GEOTHERM_TEST_LABEL})
  # gtest_discover_tests cannot pass on a property that is a list: it is set when ctest starts.
  set(file "${CMAKE_CURRENT_BINARY_DIR}/${list}_environment.cmake")
  file(WRITE "${file}" "if(${list})\n  set_tests_properties(\${${list}} PROPERTIES "
                       "ENVIRONMENT \"${environment}\")\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${file}")
endfunction()

# geotherm_add_test(NAME PROGRAM ARGUMENTS... [ENVIRONMENT VARIABLE=VALUE...]): a test that is a
# command.
function(geotherm_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" ENVIRONMENT)
  set(environment ${GEOTHERM_TEST_ENVIRONMENT} ${arg_ENVIRONMENT})
  add_test(NAME ${GEOTHERM_TEST_PREFIX}${name} COMMAND ${arg_UNPARSED_ARGUMENTS})
  set_tests_properties(${GEOTHERM_TEST_PREFIX}${name} PROPERTIES
    TIMEOUT 300 LABELS ${GEOTHERM_TEST_LABEL} ENVIRONMENT "${environment}")
endfunction()
