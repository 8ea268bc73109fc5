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
set(GEOTHERM_TEST_ENVIRONMENT "OPENBLAS_NUM_THREADS=1" "OMP_NUM_THREADS=1")
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
# a test of ctest; where there are shards, a few processes share them out.
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
  set(filter)
  if(GEOTHERM_TEST_FILTER)
    set(filter TEST_FILTER "${GEOTHERM_TEST_FILTER}")
  endif()
  gtest_discover_tests(${target} TEST_PREFIX "${GEOTHERM_TEST_PREFIX}" ${filter}
    NO_PRETTY_VALUES TEST_LIST ${target}_names DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 300 LABELS ${GEOTHERM_TEST_LABEL})
  # gtest_discover_tests cannot pass on a property that is a list: it is set when ctest starts.
  set(environment ${GEOTHERM_TEST_ENVIRONMENT} ${arg_ENVIRONMENT})
  set(file "${CMAKE_CURRENT_BINARY_DIR}/${target}_environment.cmake")
  file(WRITE "${file}" "if(${target}_names)\n  set_tests_properties(\${${target}_names} PROPERTIES "
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
