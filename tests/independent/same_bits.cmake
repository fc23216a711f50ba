# Curves CASE_DIR twice with CAMBER, on one and on three threads, into WORK_DIR: the files must be equal.
file(MAKE_DIRECTORY ${WORK_DIR})
foreach(threads 1 3)
  execute_process(COMMAND ${CAMBER} curve ${CASE_DIR}/linear.msh --geometry ${CASE_DIR}/body.step
    --threads ${threads} -o ${WORK_DIR}/${threads}.msh -o ${WORK_DIR}/${threads}.vtu -q
    COMMAND_ERROR_IS_FATAL ANY)
endforeach()
foreach(extension msh vtu)
  execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${WORK_DIR}/1.${extension}
    ${WORK_DIR}/3.${extension} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
