# SPDX-License-Identifier: MIT
# Installs the build in BUILD_DIR to an empty prefix, builds the consumer against it, runs it.
set(prefix "${WORK_DIR}/prefix")
file(REMOVE_RECURSE "${WORK_DIR}")

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${prefix}")

# The package must not lead back to where it was built.
file(GLOB_RECURSE files "${prefix}/*.cmake")
foreach(file ${files})
  file(READ "${file}" text)
  foreach(place "${SOURCE_DIR}" "${BUILD_DIR}")
    string(FIND "${text}" "${place}" position)
    if(NOT position EQUAL -1)
      message(FATAL_ERROR "${file} names ${place}")
    endif()
  endforeach()
endforeach()

# The front door is narrow: what is in it is promised to users. Twenty headers are about distances and
# lines; directions.h is about tangent planes, a notion of its own.
file(GLOB_RECURSE headers "${prefix}/include/geotherm/*")
list(LENGTH headers count)
if(count EQUAL 0 OR count GREATER 20)
  message(FATAL_ERROR "${count} headers are installed; 1 to 20 are meant to be")
endif()

run("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/project" -B "${WORK_DIR}/build"
    -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_PREFIX_PATH=${prefix}"
    -DCMAKE_BUILD_TYPE=Release)
run("${CMAKE_COMMAND}" --build "${WORK_DIR}/build")
run("${WORK_DIR}/build/consumer")
if(EXISTS "${WORK_DIR}/build/consumer_c")
  run("${WORK_DIR}/build/consumer_c")
endif()
if(PROGRAM AND NOT EXISTS "${WORK_DIR}/build/consumer_c")
  message(FATAL_ERROR "the C interface was not installed")
endif()

if(PROGRAM)
  run("${prefix}/bin/${PROGRAM}" backends)
  run("${prefix}/bin/${PROGRAM}" info bunny)
  set(bunny "share/geotherm/models/bunny.ply")
  file(WRITE "${prefix}/${bunny}" "no mesh")
  execute_process(COMMAND "${prefix}/bin/${PROGRAM}" info bunny ERROR_VARIABLE said)
  string(FIND "${said}" "${bunny}" position)
  if(position EQUAL -1)
    message(FATAL_ERROR "the installed models are not those that the program reads: ${said}")
  endif()
endif()
if(NOT EXISTS "${prefix}/share/doc/geotherm/LICENSE")
  message(FATAL_ERROR "the licence was not installed")
endif()
