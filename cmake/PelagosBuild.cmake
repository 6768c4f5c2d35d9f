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

# Sets of foreign headers, each parsed once (precompiled) for all the targets that read them; a target uses one set.
# They save about half of the time of a build. No header of our own is in them: what a file of the project may include
# is a matter of its layer alone.
#   pelagos_plain_headers    the standard library and Eigen: the libraries
#   pelagos_message_headers  these and Protobuf: what reads and writes messages
#   pelagos_program_headers  the standard library, Eigen and what command lines and reports are made with: programs
#   pelagos_test_headers     the standard library, Eigen and GoogleTest: tests
#   pelagos_link_test_headers  these, Protobuf and JSON: tests of the instructors' link
# -fpch-preprocess lets ccache keep what was compiled with them (CCACHE_SLOPPINESS=pch_defines,time_macros).
# The warnings that are off: with precompiled headers GCC 12 gives them, wrongly, about its own std::string.
set(PELAGOS_HEADER_OPTIONS -fpch-preprocess -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
# Programs' command lines and tests need no speed of their own: they call what is optimised.
set(PELAGOS_QUICK_BUILD $<$<CONFIG:Release>:-O1>)
set(PELAGOS_STANDARD_HEADERS
  <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <map> <memory> <numeric> <optional>
  <random> <span> <sstream> <string> <string_view> <thread> <variant> <vector> <Eigen/Core> <Eigen/Geometry>)

# pelagos_add_headers(name HEADERS <a> ... [LINK lib ...] [OPTIONS option ...])
function(pelagos_add_headers name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINK;OPTIONS" ${ARGN})
  set(source ${CMAKE_BINARY_DIR}/headers/${name}.cpp)
  file(GENERATE OUTPUT ${source} CONTENT "")
  add_library(${name} OBJECT ${source})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} pelagos_warnings)
  target_compile_options(${name} PRIVATE ${PELAGOS_HEADER_OPTIONS} ${ARG_OPTIONS})
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
endfunction()

# Makes the target read a set of headers; OPTIONS: those that the set was made with.
function(pelagos_use_headers name set)
  target_compile_options(${name} PRIVATE ${PELAGOS_HEADER_OPTIONS} ${ARGN})
  target_precompile_headers(${name} REUSE_FROM ${set})
endfunction()

# pelagos_add_library(name SOURCES a.cpp ... [LINK lib ...] [HEADERS set])
# A layer of the project: a static library `name` whose own include root is ./include, so that it sees
# only the layers it links to. A library without sources is an interface (headers only).
function(pelagos_add_library name)
  cmake_parse_arguments(ARG "" "HEADERS" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  if(NOT ARG_HEADERS)
    set(ARG_HEADERS pelagos_plain_headers)
  endif()
  if(ARG_SOURCES)
    add_library(${name} STATIC ${ARG_SOURCES})
    target_include_directories(${name} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/include PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
    target_link_libraries(${name} PUBLIC ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK} pelagos_warnings)
    pelagos_use_headers(${name} ${ARG_HEADERS})
  else()
    add_library(${name} INTERFACE)
    target_include_directories(${name} INTERFACE ${CMAKE_CURRENT_SOURCE_DIR}/include)
    target_link_libraries(${name} INTERFACE ${ARG_LINK})
  endif()
endfunction()

# Highway, for files with SIMD kernels. Off are sets between those that machines have, which would only cost build
# time, and vectors without a fixed length, which no struct can hold.
find_package(PkgConfig REQUIRED)
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy>=1.0.3)
add_library(pelagos_simd INTERFACE)
target_link_libraries(pelagos_simd INTERFACE PkgConfig::HWY)
target_compile_definitions(pelagos_simd INTERFACE
  "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_AVX3_DL|HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)")

# Files with SIMD kernels of the folder's library, which links pelagos_simd. They are compiled once per instruction set;
# the machine picks one at run time.
function(pelagos_simd_sources)
  set(optimise -O3)
  if(PELAGOS_SANITIZE)  # with -O3 the compiler takes minutes for some of them
    set(optimise -O1)
  endif()
  set_source_files_properties(${ARGN} PROPERTIES
    SKIP_PRECOMPILE_HEADERS ON
    COMPILE_OPTIONS "${optimise};-fopenmp-simd;-fno-math-errno;-Wno-shadow;-Wno-old-style-cast")
endfunction()

# pelagos_add_program(name SOURCES main.cpp ... [LINK lib ...])
function(pelagos_add_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} pelagos_warnings)
  pelagos_use_headers(${name} pelagos_program_headers ${PELAGOS_QUICK_BUILD})
endfunction()

# Builds the unit tests and nothing else; what the sanitizer runs of deploy/test build.
add_custom_target(unit_tests)

# pelagos_add_test(name SOURCES test_a.cpp ... [LINK lib ...] [LABELS unit] [TIMEOUT seconds] [HEADERS set] [SERIAL])
# A GoogleTest program registered with ctest, each TEST a ctest entry. SERIAL: no other test runs beside these.
function(pelagos_add_test name)
  cmake_parse_arguments(ARG "SERIAL" "LABELS;TIMEOUT;HEADERS" "SOURCES;LINK" ${ARGN})
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  if(NOT ARG_HEADERS)
    set(ARG_HEADERS pelagos_test_headers)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} pelagos_test_places GTest::gmock GTest::gtest_main pelagos_warnings)
  pelagos_use_headers(${name} ${ARG_HEADERS} ${PELAGOS_QUICK_BUILD})
  if(ARG_LABELS STREQUAL "unit")
    add_dependencies(unit_tests ${name})
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS ${ARG_LABELS} TIMEOUT ${ARG_TIMEOUT} RUN_SERIAL ${ARG_SERIAL})
endfunction()
