# SPDX-License-Identifier: MIT
# Run when a test program is built: writes a file for ctest with one test for each suite of
# parameterised tests, which one process runs. Arguments: PROGRAM, FILE, LABEL, ENVIRONMENT, FILTER.
execute_process(COMMAND "${PROGRAM}" --gtest_list_tests "--gtest_filter=${FILTER}"
                OUTPUT_VARIABLE listed RESULT_VARIABLE failed TIMEOUT 60)
if(failed)
  message(FATAL_ERROR "${PROGRAM} does not list its tests: ${failed}")
endif()
string(REGEX MATCHALL "(^|\n)[^ \n][^ \n]*/[^ \n]*\\." suites "${listed}")

# A suite runs as a whole or is skipped as a whole, so that nothing is skipped without a word.
set(part_skipped "\\\\[  PASSED  \\\\] [1-9][0-9]* tests?\\\\.[\\r\\n]+\\\\[  SKIPPED \\\\]")
set(all_skipped "\\\\[  PASSED  \\\\] 0 tests\\\\.[\\r\\n]+(\\\\[  SKIPPED \\\\] [^\\n]*[\\r\\n]+)+$")
set(content "")
foreach(suite IN LISTS suites)
  string(STRIP "${suite}" suite)
  string(REGEX REPLACE "\\.$" "" name "${suite}")
  string(APPEND content
    "add_test([[${name}]] [[${PROGRAM}]] [[--gtest_filter=${suite}*-*Slow*]])\n"
    "set_tests_properties([[${name}]] PROPERTIES TIMEOUT 600 LABELS [[${LABEL}]]\n"
    "  ENVIRONMENT [[${ENVIRONMENT}]]\n"
    "  FAIL_REGULAR_EXPRESSION \"${part_skipped}\"\n"
    "  SKIP_REGULAR_EXPRESSION \"${all_skipped}\")\n")
endforeach()
file(WRITE "${FILE}" "${content}")
