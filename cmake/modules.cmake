# camber_module(NAME SOURCES ... HEADERS ... DEPENDS ... [PRIVATE_DEPENDS ...])
#   makes the static library camber_NAME (alias camber::NAME) from the calling folder.
# camber_test(NAME SOURCES ... LIBRARIES ... [LABELS ...])
#   makes the GoogleTest program NAME and registers each of its tests with ctest.
# camber_lane_kernels(OUT BASE)
#   sources BASE_baseline.cpp, BASE_avx2.cpp .. that this compiler can build, each with its flag; the
#   choice is made at run time (base/processor.hpp). Targets that refer to them define
#   ${camber_kernel_definitions}.
include(CheckCXXCompilerFlag)
include(GNUInstallDirs)
include(GoogleTest)

set(camber_instruction_sets "")
set(camber_kernel_definitions "")
foreach(set avx2 avx512)
  string(REPLACE "avx512" "avx512f" flag -m${set})
  check_cxx_compiler_flag(${flag} CAMBER_COMPILER_HAS_${set})
  if(CAMBER_COMPILER_HAS_${set})
    list(APPEND camber_instruction_sets ${set})
    string(TOUPPER ${set} upper)
    list(APPEND camber_kernel_definitions CAMBER_KERNELS_${upper})
  endif()
endforeach()

function(camber_lane_kernels out base)
  set(sources ${base}_baseline.cpp)
  set_source_files_properties(${base}_baseline.cpp PROPERTIES COMPILE_OPTIONS -fno-math-errno)
  foreach(set ${camber_instruction_sets})
    string(REPLACE "avx512" "avx512f" flag -m${set})
    list(APPEND sources ${base}_${set}.cpp)
    set_source_files_properties(${base}_${set}.cpp PROPERTIES
      COMPILE_OPTIONS "${flag};-fno-math-errno")
  endforeach()
  set(${out} ${sources} PARENT_SCOPE)
endfunction()

set(camber_module_targets "" CACHE INTERNAL "modules in build order")

function(camber_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  set(target camber_${name})
  if(ARG_SOURCES)
    add_library(${target} STATIC ${ARG_SOURCES})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE
      $<BUILD_INTERFACE:camber_warnings> ${ARG_PRIVATE_DEPENDS})
    target_link_libraries(${target} PUBLIC $<BUILD_INTERFACE:camber_build>)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(camber::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  # Headers in detail/ belong to the module alone and are not installed.
  list(FILTER ARG_HEADERS EXCLUDE REGEX "(^|/)detail/")
  target_sources(${target} ${scope} FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src
    FILES ${ARG_HEADERS})
  target_compile_features(${target} ${scope} cxx_std_20)
  target_link_libraries(${target} ${scope} ${ARG_DEPENDS})
  set(camber_module_targets "${camber_module_targets};${target}" CACHE INTERNAL "")
endfunction()

function(camber_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES;LABELS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE camber_warnings camber_build camber_test_build ${ARG_LIBRARIES}
    GTest::gtest GTest::gtest_main GTest::gmock)
  # Each test file has helpers of its own; their names repeat.
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)
  if(CAMBER_ONE_BUILD)
    target_precompile_headers(${name} REUSE_FROM camber_test_headers)
  endif()
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  # Values of parameters are bytes and addresses; the names alone are the same in every build.
  gtest_discover_tests(${name} TEST_PREFIX "${name}/" NO_PRETTY_VALUES PROPERTIES LABELS "${ARG_LABELS}" DISCOVERY_TIMEOUT 60)
endfunction()
