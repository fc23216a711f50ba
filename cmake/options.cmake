# Project-wide options. No global compile flags: they live on interface targets.
if(PROJECT_IS_TOP_LEVEL)
  set(camber_top_level ON)
else()
  set(camber_top_level OFF)
endif()
option(CAMBER_BUILD_APPS "Build the camber command line program" ${camber_top_level})
option(CAMBER_BUILD_TESTS "Build the tests" ${camber_top_level})
option(CAMBER_BUILD_BENCH "Build the benchmarks" OFF)
option(CAMBER_WARNINGS_AS_ERRORS "Treat compiler warnings as errors" OFF)
option(CAMBER_ASSERTIONS "Check internal assertions (CAMBER_ASSERT) and libstdc++ preconditions" OFF)
option(CAMBER_FUZZ "Build the fuzzers of the readers (needs clang; see tests/fuzz)" OFF)
set(CAMBER_SANITIZE "" CACHE STRING "Sanitizers to build with, e.g. address,undefined")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

find_program(CAMBER_CCACHE ccache)
if(CAMBER_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CAMBER_CCACHE}")
endif()

# Half of a first build is the same headers again: for one build from nothing the sources of a module
# go to the compiler a dozen at a time and the tests start from a precompiled header. ./demo and
# ./test ask for it; daily work has ccache and small steps, there both are in the way.
option(CAMBER_ONE_BUILD "Compile as fast as one build from nothing can be" OFF)
if(CAMBER_ONE_BUILD AND NOT DEFINED CMAKE_UNITY_BUILD)
  set(CMAKE_UNITY_BUILD ON)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE 12)
endif()

# Warnings: private to the project, never exported.
add_library(camber_warnings INTERFACE)
target_compile_options(camber_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
  $<$<BOOL:${CAMBER_WARNINGS_AS_ERRORS}>:-Werror>)

# How every object of the project is compiled: same bits whatever the instruction set contracts.
add_library(camber_build INTERFACE)
target_compile_options(camber_build INTERFACE -ffp-contract=off)
if(CAMBER_ASSERTIONS)
  target_compile_definitions(camber_build INTERFACE CAMBER_ASSERTIONS=1 _GLIBCXX_ASSERTIONS=1)
endif()
if(CAMBER_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "CAMBER_FUZZ needs clang: -DCMAKE_CXX_COMPILER=clang++")
  endif()
  target_compile_options(camber_build INTERFACE -fsanitize=fuzzer-no-link,address,undefined
    -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(camber_build INTERFACE -fsanitize=address,undefined)
endif()
if(CAMBER_SANITIZE)
  # Instrumented code makes g++ 12 see uninitialised members inside <regex>.
  target_compile_options(camber_warnings INTERFACE -Wno-maybe-uninitialized)
  target_compile_options(camber_build INTERFACE -fsanitize=${CAMBER_SANITIZE}
    -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(camber_build INTERFACE -fsanitize=${CAMBER_SANITIZE})
endif()
