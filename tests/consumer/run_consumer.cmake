# Installs the build tree into a fresh prefix, builds the consumer against that alone, runs it.
# Needs BUILD_DIR SOURCE_DIR WORK_DIR CASE_DIR GENERATOR COMPILER CONFIG.
file(REMOVE_RECURSE ${WORK_DIR})
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix --config ${CONFIG})
run(${CMAKE_COMMAND} -S ${SOURCE_DIR}/program -B ${WORK_DIR}/build -G ${GENERATOR}
  -DCMAKE_BUILD_TYPE=${CONFIG} -DCMAKE_CXX_COMPILER=${COMPILER}
  -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix)
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${WORK_DIR}/build/one_module)
run(${WORK_DIR}/build/whole_library ${CASE_DIR}/linear.msh ${CASE_DIR}/body.step)

# Nothing of the build or source tree may leak into what users find.
file(GLOB_RECURSE exported ${WORK_DIR}/prefix/*.cmake)
foreach(file IN LISTS exported)
  file(READ ${file} text)
  foreach(leak IN ITEMS ${BUILD_DIR}/src ${BUILD_DIR}/lib camber_warnings camber_build)
    string(FIND "${text}" "${leak}" at)
    if(NOT at EQUAL -1)
      message(FATAL_ERROR "${file} names ${leak}")
    endif()
  endforeach()
endforeach()
