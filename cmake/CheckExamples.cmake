# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DPROGRAM=write_examples -DEXAMPLES=examples -DFOLDER=scratch -P CheckExamples.cmake
# Fails when the shipped example scripts are not what the table of filters gives.
file(MAKE_DIRECTORY ${FOLDER})
execute_process(COMMAND ${PROGRAM} ${FOLDER} RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} failed")
endif()
foreach(script texture_atlas stages paper pattern)
  execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files --ignore-eol ${FOLDER}/${script}.mlx
                          ${EXAMPLES}/${script}.mlx RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(SEND_ERROR "examples/${script}.mlx is not current; run: ${PROGRAM} ${EXAMPLES}")
  endif()
endforeach()
