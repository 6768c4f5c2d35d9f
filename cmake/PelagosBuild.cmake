# What every target of the project shares: language level, warnings, sanitizers, output folders, helpers.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)

option(PELAGOS_WERROR "Treat warnings as errors" OFF)
set(PELAGOS_SANITIZE "" CACHE STRING "Sanitizers to build with, as in -fsanitize=, e.g. address,undefined or thread")

# ccache, where it is installed, keeps what was compiled, for every clone of the project: paths inside the clone are
# hashed relative to it, and the folder of the build is not hashed.
find_program(PELAGOS_CCACHE ccache DOC "Keeps compiled files for the next build; empty: not used")
if(PELAGOS_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
    CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=true CCACHE_SLOPPINESS=pch_defines,time_macros
    ${PELAGOS_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${CMAKE_CXX_COMPILER_LAUNCHER})
endif()

# Results must not depend on whether the compiler fuses a multiply and an add somewhere else.
add_compile_options(-ffp-contract=off)
if(PELAGOS_SANITIZE)
  add_compile_options(-fsanitize=${PELAGOS_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${PELAGOS_SANITIZE})
endif()

# Warnings as an interface target: our own code links it, generated code does not.
# -Wno-restrict: GCC 12 warns wrongly of overlapping copies in "literal" + std::string (GCC bug 105651).
add_library(pelagos_warnings INTERFACE)
target_compile_options(pelagos_warnings INTERFACE
  -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual -Wcast-align
  -Wno-restrict
  $<$<BOOL:${PELAGOS_WERROR}>:-Werror>)

# pelagos_add_library(name SOURCES a.cpp ... [LINK lib ...])
# A layer of the project: a static library `name` whose own include root is ./include, so that it sees
# only the layers it links to. A library without sources is an interface (headers only).
function(pelagos_add_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  if(ARG_SOURCES)
    add_library(${name} STATIC ${ARG_SOURCES})
    target_include_directories(${name} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/include PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
    target_link_libraries(${name} PUBLIC ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK} pelagos_warnings)
  else()
    add_library(${name} INTERFACE)
    target_include_directories(${name} INTERFACE ${CMAKE_CURRENT_SOURCE_DIR}/include)
    target_link_libraries(${name} INTERFACE ${ARG_LINK})
  endif()
endfunction()

# pelagos_add_program(name SOURCES main.cpp ... [LINK lib ...])
function(pelagos_add_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} pelagos_warnings)
endfunction()

# Builds the unit tests and nothing else; what the sanitizer runs of deploy/test build.
add_custom_target(unit_tests)

# The foreign headers that nearly every test reads, parsed once, and little optimising: the tests call what is
# optimised, and compile in 0.6 to 0.7 of the time.
# -fpch-preprocess lets ccache keep what was compiled with them (CCACHE_SLOPPINESS=pch_defines,time_macros).
# The warnings that are off: with precompiled headers GCC 12 gives them, wrongly, about its own std::string.
set(PELAGOS_TEST_OPTIONS -fpch-preprocess -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread
  $<$<CONFIG:Release>:-O1>)
function(pelagos_add_test_headers)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/test_headers.cpp)
  file(GENERATE OUTPUT ${source} CONTENT "")
  add_library(pelagos_test_headers OBJECT ${source})
  target_link_libraries(pelagos_test_headers PUBLIC GTest::gmock Eigen3::Eigen pelagos_warnings Threads::Threads)
  target_compile_options(pelagos_test_headers PUBLIC ${PELAGOS_TEST_OPTIONS})
  target_precompile_headers(pelagos_test_headers PRIVATE
    <gmock/gmock.h> <gtest/gtest.h> <Eigen/Core> <Eigen/Geometry>
    <algorithm> <array> <chrono> <cmath> <filesystem> <fstream> <functional> <map> <memory> <optional> <random> <span>
    <string> <thread> <vector>)
endfunction()

# pelagos_add_test(name SOURCES test_a.cpp ... [LINK lib ...] [LABELS unit] [TIMEOUT seconds] [SERIAL])
# A GoogleTest program registered with ctest, each TEST a ctest entry. SERIAL: no other test runs beside these.
function(pelagos_add_test name)
  cmake_parse_arguments(ARG "SERIAL" "LABELS;TIMEOUT" "SOURCES;LINK" ${ARGN})
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} pelagos_test_places GTest::gmock GTest::gtest_main pelagos_warnings)
  target_compile_options(${name} PRIVATE ${PELAGOS_TEST_OPTIONS})
  target_precompile_headers(${name} REUSE_FROM pelagos_test_headers)
  if(ARG_LABELS STREQUAL "unit")
    add_dependencies(unit_tests ${name})
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS ${ARG_LABELS} TIMEOUT ${ARG_TIMEOUT} RUN_SERIAL ${ARG_SERIAL})
endfunction()
