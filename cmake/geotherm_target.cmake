# SPDX-License-Identifier: MIT

# GEOTHERM_SANITIZE (a list such as "address;undefined" or "thread", set by presets) instruments
# everything that is built here; what is linked from the system stays as it is.
set(GEOTHERM_SANITIZE "" CACHE STRING "Sanitizers to build with: address;undefined or thread")
if(GEOTHERM_SANITIZE)
  list(JOIN GEOTHERM_SANITIZE "," _sanitizers)
  add_compile_options(-fsanitize=${_sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${_sanitizers})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-Wno-maybe-uninitialized)  # false alarms in instrumented code
    if("address" IN_LIST GEOTHERM_SANITIZE)
      # Pointers to nothing end the program there anyhow, and these checks of each pointer (is it
      # aligned, large enough, of that class, still an address) take a third of the time to build; the
      # fuzzers (clang) make them.
      add_compile_options(-fno-sanitize=null,alignment,object-size,vptr,pointer-overflow)
      # So does marking each local as gone where its block ends. Functions that have returned are
      # watched (ASAN_OPTIONS), and the fuzzers watch the blocks.
      add_compile_options(-fno-sanitize-address-use-after-scope)
    endif()
  endif()
endif()

# The compiler looks for memory to use again from 128 MB on, a tenth of its time: later, where there is
# plenty for each of the processes that compile, which then take up to 4 GB in place of 2.6.
cmake_host_system_information(RESULT _megabytes QUERY TOTAL_PHYSICAL_MEMORY)
cmake_host_system_information(RESULT _cores QUERY NUMBER_OF_LOGICAL_CORES)
math(EXPR _megabytes_each "${_megabytes} / ${_cores}")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND _megabytes_each GREATER 6000)
  add_compile_options(--param=ggc-min-heapsize=2000000)
endif()

option(GEOTHERM_UNITY "Compile the sources of a target together" ON)

# What every target of the project has in common.
function(geotherm_target name)
  target_compile_features(${name} PUBLIC cxx_std_20)
  set_target_properties(${name} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                         -Wno-sign-conversion)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # False alarms on "text" + std::string (GCC bug 105651); the sanitizers see the real ones.
    target_compile_options(${name} PRIVATE -Wno-restrict -Wno-stringop-overflow
                           -Wno-array-bounds)
  endif()
endfunction()

# geotherm_compile_together(TARGET [COUNT]): all sources of its list at once, or COUNT at a time where
# that would need more memory than the scripts expect (scripts/common.sh). Headers (CLI11, JSON, Vulkan,
# Dear ImGui, GoogleTest) and templates take longer to compile than sources do. Names in anonymous
# namespaces must differ within a target: one compiler error tells. Off in the presets dev and tidy,
# where a missing include must be noticed.
function(geotherm_compile_together name)
  if(NOT GEOTHERM_UNITY)
    return()
  endif()
  set(count 0)
  if(ARGC GREATER 1)
    set(count ${ARGV1})
  endif()
  set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${count})
  # A class of one source may hold what is in an anonymous namespace; the compiler takes the source
  # for a header. Local names may be those that other sources have at their top.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${name} PRIVATE -Wno-subobject-linkage -Wno-shadow -Wshadow=local)
  endif()
endfunction()

# geotherm_compile_lightly(TARGET): for what reads options, prints, draws and lays out panels: -O3 would
# take half as long again to compile, and a picture of a million faces is there 2 to 5 % sooner with it;
# where it is debugged, -Og takes a fifth less than -O1.
function(geotherm_compile_lightly name)
  target_compile_options(${name} PRIVATE $<IF:$<CONFIG:Release>,-O1,-Og>)
endfunction()
